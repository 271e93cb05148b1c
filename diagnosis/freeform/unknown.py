"""What is reported about an unknown log in addition to the library's nearest explanation."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diagnosis.assessment.assess import Assessment
from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.explained import explained_by
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.likeness.plain_fits import with_plain_laws
from diagnosis.freeform.missing.missing import Missing, missing_of
from diagnosis.freeform.search import free_form_fits
from diagnosis.log.rig_log import RigLog
from diagnosis.replay.prediction import Prediction
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.stopping import StoppedEarly
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

FREE_FORM = "free-form laws"


def with_what_is_missing(
    log: RigLog,
    problem: FitProblem,
    coarse: FitProblem,
    nominal: Sequence[Prediction],
    verdict: Verdict,
    assessment: Assessment,
    effects: Sequence[str],
    workers: Workers,
) -> tuple[Missing | None, Assessment]:
    """What is missing, and the assessment with its law; None and `assessment` if the log is not unknown.

    Args:
      nominal: readings of the nominal rig by trial of the problem.
      effects: of the library, which may stand beside a law.
    """
    if verdict.kind is not VerdictKind.UNKNOWN:
        return None, assessment
    stop = workers.stop
    fits = () if stop.due else _fits(problem, coarse, effects, workers)
    if stop.due:
        stop.leave_out(FREE_FORM)  # those that are done tell something all the same
    if not any(fit.final for fit in fits):
        return None, assessment
    nearest = assessment.nearest
    refused = verdict.other_form or (nearest.at_bound and nearest.gap_after <= CLOSED_GAP)
    one_trial = len(log.trials) == 1
    missing = missing_of(fits, np.inf if refused else nearest.gap_after, one_trial=one_trial)
    if missing.law is None:
        return missing, assessment
    explained = explained_by(missing, log, problem, nominal, assessment)
    if explained.gap.after > explained.gap.before and not missing.closed:
        return replace(missing, law=None), assessment  # it predicts less than the nominal rig
    return missing, explained


def _fits(
    problem: FitProblem, coarse: FitProblem, effects: Sequence[str], workers: Workers
) -> tuple[FreeFit, ...]:
    """Free-form fits; empty if the nominal rig cannot be simulated, or there was no time."""
    try:
        fits = free_form_fits(problem, coarse, effects, workers)
    except (SimulationFailed, StoppedEarly):
        return ()
    return fits if workers.stop.due else with_plain_laws(problem, coarse, fits, workers)

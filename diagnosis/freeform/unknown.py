"""What is reported about an unknown log in addition to the library's nearest explanation."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.assessment.assess import assess
from diagnosis.assessment.assessment import Assessment
from diagnosis.criteria.freeform import CLOSED_GAP
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.explained import explained_by
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.fits.noise_left import in_noise, noise_left
from diagnosis.freeform.likeness.plain_fits import with_plain_laws
from diagnosis.freeform.missing.missing import Missing, missing_of
from diagnosis.freeform.search import fits_in_noise, free_form_fits
from diagnosis.log.rig_log import RigLog
from diagnosis.replay.prediction import Prediction
from diagnosis.selection.candidate import candidate
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.stopping import StoppedEarly
from diagnosis.workers import Workers
from sim.needles.run import SimulationFailed

FREE_FORM = "free-form laws"
Problems = tuple[FitProblem, FitProblem]  # the log itself, and decimated


@dataclass(frozen=True, kw_only=True, eq=False)
class Told:
    """What is told of a log.

    Attributes:
      problem: the log, with the noise that everything is told in.
      missing: what the library lacks; None: nothing, or nobody knows.
    """

    problem: FitProblem
    verdict: Verdict
    assessment: Assessment
    missing: Missing | None = None


def with_what_is_missing(
    log: RigLog,
    known: Told,
    coarse: FitProblem,
    nominal: Sequence[Prediction],
    effects: Sequence[str],
    workers: Workers,
) -> Told:
    """What is missing besides what is known, and the assessment with its law, of a log that is unknown.

    Where the law shows that the noise is less than what was taken for it, all is told in that.

    Args:
      nominal: readings of the nominal rig by trial of the problem.
      effects: of the library, which may stand beside a law.
    """
    if known.verdict.kind is not VerdictKind.UNKNOWN:
        return known
    stop = workers.stop
    fits, found = ((), None) if stop.due else _fits(known.problem, coarse, effects, workers)
    if stop.due:
        stop.leave_out(FREE_FORM)  # those that are done tell something all the same
    if not any(fit.final for fit in fits):
        return known
    if found:
        known = _in_that_noise(log, known, found, nominal, effects, workers)
    return _told(log, known, fits, nominal)


def _told(log: RigLog, known: Told, fits: Sequence[FreeFit], nominal: Sequence[Prediction]) -> Told:
    nearest, one_trial = known.assessment.nearest, len(log.trials) == 1
    refused = known.verdict.other_form or (nearest.at_bound and nearest.gap_after <= CLOSED_GAP)
    missing = missing_of(fits, np.inf if refused else nearest.gap_after, one_trial=one_trial)
    if missing.law is None:
        return replace(known, missing=missing)
    explained = explained_by(missing, log, known.problem, nominal, known.assessment)
    if explained.gap.after > explained.gap.before and not missing.closed:
        return replace(
            known, missing=replace(missing, law=None)
        )  # it predicts less than the nominal rig
    return replace(known, missing=missing, assessment=explained)


def _fits(
    problem: FitProblem, coarse: FitProblem, effects: Sequence[str], workers: Workers
) -> tuple[tuple[FreeFit, ...], Problems | None]:
    """Free-form fits, and the problems with the noise that they leave; None: that is as it was.

    There are none if the nominal rig cannot be simulated, or there was no time.
    """
    try:
        fits = free_form_fits(problem, coarse, effects, workers)
    except (SimulationFailed, StoppedEarly):
        return (), None
    fits, quieter = _in_the_noise_left(problem, coarse, fits, effects, workers)
    if workers.stop.due:
        return fits, quieter
    return with_plain_laws(*(quieter or (problem, coarse)), fits, workers), quieter


def _in_the_noise_left(
    problem: FitProblem,
    coarse: FitProblem,
    fits: tuple[FreeFit, ...],
    effects: Sequence[str],
    workers: Workers,
) -> tuple[tuple[FreeFit, ...], Problems | None]:
    """The fits in the noise that they leave, and the problems with that; None: it is no less.

    After a stop, and where none of them can be simulated in that noise, they are as they were.
    """
    noise = None if workers.stop.due else noise_left(problem, fits)
    if noise is None:
        return fits, None
    quieter = in_noise(problem, coarse, noise)
    try:
        again = fits_in_noise((problem, coarse), quieter, fits, effects, workers)
    except (SimulationFailed, StoppedEarly):
        return fits, None
    done = any(f.final for f in again) and not workers.stop.due
    return (again, quieter) if done else (fits, None)


def _in_that_noise(
    log: RigLog,
    known: Told,
    found: Problems,
    nominal: Sequence[Prediction],
    effects: Sequence[str],
    workers: Workers,
) -> Told:
    """What is known in units of the noise that a law leaves, and assessed anew."""
    problem, coarse = found
    best = candidate(rescaled(known.verdict.best.fit, known.problem, problem.noise))
    verdict = replace(known.verdict, best=best)
    assessment = assess(log, problem, coarse, nominal, verdict, effects, workers)
    return Told(problem=problem, verdict=verdict, assessment=assessment)

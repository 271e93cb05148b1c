"""Everything that is reported in addition to the verdict."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import TypeVar

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.advice.advice import advise
from diagnosis.assessment.assessment import Assessment
from diagnosis.assessment.attempts import Attempts
from diagnosis.assessment.detection_limits import DetectionLimit, detection_limits
from diagnosis.assessment.forward_step import Further, further_effects, gap_with_one_more, has_room
from diagnosis.assessment.gap_reduction import GapReduction, gap_reduction
from diagnosis.assessment.moved_by_hidden import moved_by_hidden
from diagnosis.assessment.nearest import ONE_MORE, nearest_candidate, nearest_of
from diagnosis.assessment.replayed import Replayed
from diagnosis.assessment.sensor_errors import sensor_errors
from diagnosis.assessment.twist_by_effect import twist_by_effect
from diagnosis.assessment.uncertainty.intervals import Interval, covariance, intervals
from diagnosis.assessment.uncertainty.joint_uncertainty import joint_uncertainty
from diagnosis.assessment.uncertainty.partitions import by_motion, trial_by_trial
from diagnosis.assessment.uncertainty.values_by_part import ValuesByPart, values_by_part
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.noise_reestimation import in_units_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.rig_log import RigLog
from diagnosis.nominal_replay import nominal_residuals
from diagnosis.replay.accuracy.numerical_error import (
    numerical_error,
    numerical_warnings,
    refinement_change,
)
from diagnosis.replay.prediction import Prediction
from diagnosis.residuals.largest_moment import largest_moment
from diagnosis.residuals.residual_breakdown import ResidualBreakdown, residual_breakdown
from diagnosis.residuals.residual_shape import residual_shape
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.contributions import strongest_first
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind
from diagnosis.stopping import StopSignal, stopping
from diagnosis.workers import Failure, Workers

Array = NDArray[np.float64]
T = TypeVar("T")

TO_ITS_END = "diagnose this log to its end first: what was not tried may explain it as well, or better"
"""In place of a next experiment where the search was cut short."""
FINER, REPLICATES = "numerical error", "noise of the base angle in the intervals"
LIMITS, NEXT = "detection limits", "next experiment"
_NO_PARTS: tuple[tuple[ValuesByPart, ...], ...] = ()
ORDER = "order of the effects by strength"
TWIST, BY_PART = "twist along the shaft", "values by trial and motion"
"""Parts that a stop leaves out."""


def assess(
    log: RigLog,
    problem: FitProblem,
    coarse: FitProblem,
    nominal: Sequence[Prediction],
    verdict: Verdict,
    effects: Sequence[str],
    workers: Workers,
) -> Assessment:
    """Assess a verdict; after a stop, everything that needs many simulations is left out.

    Args:
      problem: the log itself, with the resolution and the noise that the verdict is based on.
      coarse: the decimated log, with the same noise.
      nominal: readings that the nominal rig predicts, by trial of the problem.
      effects: names of effects that may be tried.

    Raises:
      SimulationFailed: the best explanation cannot be simulated.
    """
    stop = workers.stop
    complete = not stop.left_out
    further = cache(lambda: _further(coarse, verdict, effects, workers))  # where it is asked for first
    near, after, lost = nearest_candidate(problem, coarse, nominal, verdict, further, effects, workers)
    read = Replayed.of(log, problem, nominal, near)
    arguments = (problem.log, problem.noise, read.rig, read.predictions, problem.resolution)
    change = stop.unless_due(FINER, lambda: refinement_change(*arguments)) or []
    error = numerical_error(change) if change else {}
    where = residual_breakdown(read.before), residual_breakdown(read.left)
    tried = Attempts()
    named = verdict.effects or tried.or_else(ORDER, lambda: strongest_first(problem, near), near.named)
    spread_of = workers.begin(partial(covariance, problem, near.fit, change, left=_above_noise(near)))
    twist_of = workers.begin(twist_by_effect, problem, near, named, largest_moment(read.before))
    beside = further()
    fitted_gap = _fitted_gap(problem, verdict.best)
    with_one_more = gap_with_one_more(fitted_gap, beside) if beside else {}
    spread = tried.or_else(REPLICATES, spread_of, _inverse_information(near))
    if stop.due:
        stop.leave_out(REPLICATES)
    own = intervals(near.fit, spread)
    accepted = {e: p for e, p in own.items() if e in verdict.effects}
    advice_of = workers.begin(_advice, coarse, verdict, *where, accepted) if complete else None
    limits = _limits(coarse, verdict, beside, effects, workers) if beside else {}
    advice = tried.or_else(NEXT, lambda: _next_experiment(verdict, advice_of, stop), "")
    by_parts = tried.or_else(BY_PART, lambda: _by_parts(problem, near, verdict, stop), _NO_PARTS)
    gap = _gap(problem, nominal, after)
    return Assessment(
        gap=gap,
        fitted_gap=fitted_gap,
        nearest=nearest_of(near, named, own, gap, *by_parts),
        breakdown=where[0],
        breakdown_after=where[1],
        shape=residual_shape(read.before),
        shape_after=residual_shape(read.left),
        parameters=accepted,
        joint=joint_uncertainty(near.fit, spread, named),
        sensors=sensor_errors(problem, read.rig, read.predictions, own),
        with_one_more=with_one_more,
        detection_limits=limits,
        next_experiment=advice,
        numerical_error=error,
        explained=read.explained,
        twist=stop.unless_due(TWIST, twist_of),
        warnings=(
            *problem.log.warnings,
            *numerical_warnings(error),
            *lost,
            *tried.warnings,
            *moved_by_hidden(limits, accepted),
            *_bound_warnings(near.told_at_bound, verdict.kind),
        ),
    )


def _gap(problem: FitProblem, nominal: Sequence[Prediction], after: Sequence[Array]) -> GapReduction:
    """The gap before and after, in units of the noise as if it were white."""
    plain = problem.noise.uncoloured
    before = nominal_residuals(replace(problem, noise=plain), nominal)
    return gap_reduction(before, in_units_of(problem, after, plain))


def _fitted_gap(problem: FitProblem, best: Candidate) -> float:
    """What an explanation leaves on the trials of its fit, in units of the noise as if it were white."""
    return floor_of(in_units_of(problem, best.fit.by_trial, problem.noise.uncoloured)).gap


def _advice(
    coarse: FitProblem,
    verdict: Verdict,
    nominal: ResidualBreakdown,
    left: ResidualBreakdown,
    parameters: Mapping[str, Mapping[str, Interval]],
) -> tuple[str, bool]:
    """The next experiment in words, and whether runs were simulated for it: after a stop, none are."""
    whole = not stopping()
    return advise(coarse, verdict, nominal, left, parameters), whole


def _next_experiment(
    verdict: Verdict, advice_of: Callable[[], tuple[str, bool]] | None, stop: StopSignal
) -> str:
    """The next experiment in words; after a stop, what to change stands alone."""
    if advice_of is None:
        return TO_ITS_END
    advice, whole = advice_of()
    if not whole and verdict.kind in (VerdictKind.EXPLAINED, VerdictKind.UNDECIDED):
        stop.leave_out(NEXT)
    return advice


def _by_parts(
    problem: FitProblem, near: Candidate, verdict: Verdict, stop: StopSignal
) -> tuple[tuple[ValuesByPart, ...], ...]:
    """Parameters of an unknown log with values of their own in each trial, and in each motion."""
    if verdict.kind is not VerdictKind.UNKNOWN:
        return ()
    parts = (own(problem, near.fit) for own in (trial_by_trial, by_motion))
    return stop.unless_due(BY_PART, lambda: values_by_part(problem, near.fit, *parts)) or ()


def _bound_warnings(at_bound: Sequence[str], kind: VerdictKind) -> tuple[str, ...]:
    """A warning for every parameter that the fit would move beyond its bound."""
    whose = "what comes nearest, which is no explanation: " if kind is VerdictKind.UNKNOWN else ""
    return tuple(
        f"{whose}{parameter} stopped at a bound of its range: the data call for a value beyond it, so "
        "its value and interval mean little"
        for parameter in at_bound
    )


def _inverse_information(best: Candidate) -> Array:
    """The covariance without what the noise of the base and of the replay add."""
    return np.asarray(np.linalg.pinv(information(best.fit)), float)


def _above_noise(best: Candidate) -> float:
    """Factor by which the residual exceeds noise, slow parts included; 1 at the noise floor."""
    return 1.0 if best.floor.reached else max(1.0, best.floor.gap, best.floor.slow)


def _further(
    coarse: FitProblem, verdict: Verdict, effects: Sequence[str], workers: Workers
) -> Further | None:
    """Each further effect beside the best; None if that was stopped, or cannot be simulated.

    Nor is it asked for if nothing explains the log, and one more could not change that by much.
    """
    if verdict.kind is VerdictKind.UNKNOWN and not has_room(verdict.best.fit):
        return None
    found, stop = further_effects(coarse, verdict.best.fit, effects, workers), workers.stop
    if stop.due:
        stop.leave_out(ONE_MORE)
    if stop.due and verdict.settled:
        stop.leave_out(LIMITS)
    return None if stop.due or isinstance(found, Failure) else found


def _limits(
    coarse: FitProblem, verdict: Verdict, further: Further, effects: Sequence[str], workers: Workers
) -> dict[str, DetectionLimit]:
    """Detection limits, if the log is explained."""
    if not verdict.settled:
        return {}
    arguments = (coarse, verdict.best.fit, further.base, effects, workers)
    return workers.stop.unless_due(LIMITS, lambda: detection_limits(*arguments)) or {}

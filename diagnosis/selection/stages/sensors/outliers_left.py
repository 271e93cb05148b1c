"""Where nothing explains a log: readings far off the best explanation, whose neighbours are not.

Outliers are looked for before any model is known, beside the samples on both sides; here beside an
explanation (log/faults/outlying.py). They are left out if they are few, if that takes off a good part of
what is left beyond noise, and if the log is explained then, or with one more imperfection of the
recording.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import OUTLIER_LEFT_SHARE
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor, in_units_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.faults.left_out import LeftOut
from diagnosis.log.faults.outlying import few, outlying
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.scoring.beyond_noise import cost_beyond_noise
from diagnosis.selection.stages.stage import Stage, first_that_explains, leading_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

STAGE = "outliers beside the best"


@dataclass(frozen=True, kw_only=True, eq=False)
class _Readings:
    """Readings of a sensor in a trial beside an explanation.

    Attributes:
      time_s: (N,).
      off: mask of outliers, (N,).
      squares: what each reading adds to the cost, whitened, (N,).
    """

    trial: str
    sensor: str
    time_s: Array
    off: Mask
    squares: Array

    @property
    def cost_of_outliers(self) -> float:
        """What they add to the cost; where noise is coloured, also by the reading after each of them."""
        after = np.append(False, self.off[:-1])
        return float(np.sum(self.squares[self.off | after]))


def outliers_beside_the_best(state: SearchState, workers: Workers) -> SearchState:
    """The state without readings that are far off the best, where only that explains the log."""
    state, explained = state.rechecked()
    without = None if explained else _without_outliers(state, workers)
    if without is None:
        return state
    again, explained = without.rechecked()
    if not explained:
        return state.noting(
            noted(STAGE, Decision.DROPPED, "without them the log is not explained either")
        )
    return again.noting(noted(STAGE, Decision.KEPT, "without them the log is explained"))


def outliers_and_more(others: Sequence[Stage]) -> Stage:
    """A stage: what else a recording may lack is asked once more without outliers.

    Neither they nor a drift or a jump are all that is left where a recording has both.

    Args:
      others: stages that allow for it; the first that explains the log is kept.
    """

    def outliers_and_another_imperfection(state: SearchState, workers: Workers) -> SearchState:
        state, explained = state.rechecked()
        without = None if explained else _without_outliers(state, workers)
        found = first_that_explains(others, without, workers) if without else None
        reason = "without them it explains the log"
        return found.noting(noted(STAGE, Decision.KEPT, reason)) if found else state

    return outliers_and_another_imperfection


def _without_outliers(state: SearchState, workers: Workers) -> SearchState | None:
    """The state without outliers, the leading explanations fitted anew; None: there are none."""
    found = _found(state.problem, state.best.fit)
    if not _are_worth_a_fit(state, found):
        return None
    begun = _without(state, found)
    return begun.adding(leading_fitted_again(STAGE, state, begun.problem, workers))


def _found(problem: FitProblem, fit: Fit) -> list[_Readings]:
    """The readings beside a fit, in the order of its residuals."""
    plain = in_units_of(problem, fit.by_trial, problem.noise.uncoloured)
    each = zip(
        problem.log.trials,
        by_trial_and_sensor(problem, plain),
        by_trial_and_sensor(problem, fit.by_trial),
        strict=True,
    )
    return [
        _Readings(
            trial=trial.name, sensor=sensor, time_s=time_s, off=outlying(left), squares=whitened**2
        )
        for trial, parts, white in each
        for (sensor, time_s, left), (_, _, whitened) in zip(parts, white, strict=True)
    ]


def _are_worth_a_fit(state: SearchState, found: Sequence[_Readings]) -> bool:
    """Whether outliers are few, and a good part of what is left beyond noise."""
    taken_off = sum(one.cost_of_outliers for one in found)
    enough = taken_off > OUTLIER_LEFT_SHARE * cost_beyond_noise(state.best.fit)
    return enough and all(few(one.off) for one in found)


def _without(state: SearchState, found: Sequence[_Readings]) -> SearchState:
    """The state of a log without outliers, to which nothing has been fitted but the nominal rig."""
    left_out = [
        LeftOut(trial=one.trial, sensor=one.sensor, times_s=one.time_s[one.off], samples=one.off.size)
        for one in found
        if one.off.any()
    ]
    trials = state.problem.log.trials
    problem = replace(
        state.problem, log=replace(state.problem.log, trials=tuple(_less(t, left_out) for t in trials))
    )
    read = ([one.off for one in found if one.trial == trial.name] for trial in trials)
    kept = [~np.concatenate(off or [np.zeros(0, bool)]) for off in read]
    nominal = _of_rows(state.nominal, kept)
    return replace(
        state,
        problem=problem,
        nominal=nominal,
        candidates=(candidate(nominal),),
        checked=None,
        left_out=(*state.left_out, *left_out),
    )


def _less(trial: PreparedTrial, left_out: Sequence[LeftOut]) -> PreparedTrial:
    """The trial without readings that are left out."""
    own = {one.sensor: one for one in left_out if one.trial == trial.name}
    less = {sensor: one.without(trial.time_s, trial.readings[sensor]) for sensor, one in own.items()}
    return replace(trial, readings={**trial.readings, **less})


def _of_rows(fit: Fit, kept: Sequence[Mask]) -> Fit:
    """The fit with some rows of its residuals only, by trial."""
    left = tuple(own[rows] for own, rows in zip(fit.by_trial, kept, strict=True))
    slopes = tuple(own[rows] for own, rows in zip(fit.jacobian, kept, strict=True))
    cost = sum(float(own @ own) for own in left) + fit.prior
    return replace(fit, by_trial=left, jacobian=slopes, cost=cost)

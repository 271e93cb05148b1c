"""Parameters of a fit with 95 % intervals.

Four errors move a fitted parameter: the noise of the sensors, or by how much parts of the log disagree
(`scatter_of_parts`); the remaining noise of the base angle in the motion that drives the replay; the
numerical error of the replay; and what a fit leaves to go to its minimum. The second is found by
repetition: noise is added to the smoothed motion, which is smoothed again, and one Gauss-Newton step
gives the shift of the fit. The third is the shift by a Gauss-Newton step for a finer replay, the fourth
the step that the fit itself would take next.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.uncertainty.scatter_of_parts import covariance_by_parts
from diagnosis.criteria.assessment import INTERVAL_Z
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.resolution import FINE
from diagnosis.stopping import stopping

Array = NDArray[np.float64]

_REPLICATES = 6
_SEED = 20
_NOTHING = np.zeros(0)


@dataclass(frozen=True, kw_only=True)
class Interval:
    """A parameter's value and 95 % interval, in its unit."""

    value: float
    low: float
    high: float
    unit: str


def covariance(
    problem: FitProblem,
    fit: Fit,
    change: Sequence[Mapping[str, Array]],
    *,
    left: float = 1.0,
) -> Array:
    """Covariance of the vector of a fit, (n, n), in the units of the fit.

    Args:
      change: change of the prediction by a finer replay, / sigma, by trial and sensor; empty: ignored.
      left: factor by which the residual exceeds the noise, of an incomplete model.
    """
    if fit.x.size == 0:
        return np.zeros((0, 0))
    inverse = np.asarray(np.linalg.pinv(information(fit)), float)
    again = _shifts(problem, fit, inverse)
    moved = [np.concatenate([*c.values(), _NOTHING]) for c in change]
    finer = _answer(fit, inverse, moved) if moved else np.zeros(fit.x.size)
    known = covariance_by_parts(problem, fit, inverse, left)
    rest = fit.next_step
    return np.asarray(
        known + again.T @ again / len(again) + np.outer(finer, finer) + np.outer(rest, rest)
    )


def intervals(fit: Fit, spread: Array) -> dict[str, dict[str, Interval]]:
    """Intervals by effect and parameter, including nuisance parameters.

    Args:
      spread: covariance of the vector of the fit, (n, n).
    """
    parameterization = fit.parameterization
    low, high = parameterization.bounds()
    half = INTERVAL_Z * np.sqrt(np.diag(spread))
    ends = [np.clip(fit.x + s * half, low, high) for s in (-1, 1)]
    values = [parameterization.values(x) for x in (fit.x, *ends)]
    found: dict[str, dict[str, Interval]] = {}
    each = zip(parameterization.owners, parameterization.parameters, *values, strict=True)
    for owner, parameter, value, one, other in each:
        if parameter.reported:
            found.setdefault(owner, {})[parameter.name] = _interval(parameter, value, one, other)
    return found


def _interval(parameter: Parameter, value: float, one: float, other: float) -> Interval:
    """Value and interval of one parameter; an angle is shifted to within half a period of 0."""
    turns = parameter.turns(value)
    low, high = min(one, other) - turns, max(one, other) - turns
    return Interval(value=value - turns, low=low, high=high, unit=parameter.unit)


def _shifts(problem: FitProblem, fit: Fit, inverse: Array) -> Array:
    """Shifts of the fit by the remaining noise of the base angle, for K draws, (K, n).

    They are computed with the usual resolution, even if the fit needed a finer one.
    """
    rng = np.random.default_rng(_SEED)
    rig, usual = fit.parameterization.rig(fit.x), replace(problem, resolution=FINE)
    if stopping():
        return np.zeros((1, fit.x.size))
    here, found = usual.residuals([rig], callback_alone=True), list[Array]()
    while not stopping() and len(found) < _REPLICATES:
        runs = usual.read_again(rng).residuals([rig], callback_alone=True)
        moved = [run[0] - left[0] for run, left in zip(runs, here, strict=True)]
        found.append(_answer(fit, inverse, moved))
    return np.array(found or [np.zeros(fit.x.size)])


def _answer(fit: Fit, inverse: Array, moved: Sequence[Array]) -> Array:
    """Shift of a fit when its residuals change, (n,)."""
    pull = sum(slopes.T @ change for slopes, change in zip(fit.jacobian, moved, strict=True))
    return np.asarray(-inverse @ pull)

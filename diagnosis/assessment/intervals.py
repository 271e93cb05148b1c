"""Parameters of a fit with intervals that cover.

Three things move a fitted parameter: the noise of the sensors, whose covariance is
that of least squares, prior included; what is left of the base angle's noise in the
motion that drives the replay; and the replay's own error. The second is seen by doing
it again: noise is put on the smoothed motion, smoothed again, and the fit answers by
a Gauss-Newton step, as it does to a finer replay.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import INTERVAL_Z
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
    """Covariance of the vector of a fit, (n, n), in the units that it is fitted in.

    Args:
      change: of the prediction with a finer replay, / sigma, by trial and sensor; none: not looked at.
      left: by how much the residual is above the noise; noise is taken to be as much larger.
    """
    if fit.x.size == 0:
        return np.zeros((0, 0))
    inverse = np.asarray(np.linalg.pinv(information(fit)), float)
    again = _shifts(problem, fit, inverse)
    moved = [np.concatenate([*c.values(), _NOTHING]) for c in change]
    finer = _answer(fit, inverse, moved) if moved else np.zeros(fit.x.size)
    return np.asarray(left**2 * inverse + again.T @ again / len(again) + np.outer(finer, finer))


def intervals(fit: Fit, spread: Array) -> dict[str, dict[str, Interval]]:
    """By effect and parameter, nuisance included.

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
    """An angle is told in the half periods about 0."""
    turns = parameter.turns(value)
    low, high = min(one, other) - turns, max(one, other) - turns
    return Interval(value=value - turns, low=low, high=high, unit=parameter.unit)


def _shifts(problem: FitProblem, fit: Fit, inverse: Array) -> Array:
    """How far the fit moves with the noise that is left in the base angle, (K, n).

    That takes no finer replay than the usual one, also where the fit asked for it.
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
    """How far a fit moves when its residuals do, (n,)."""
    pull = sum(slopes.T @ change for slopes, change in zip(fit.jacobian, moved, strict=True))
    return np.asarray(-inverse @ pull)

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

from diagnosis.base_motion import smoothed
from diagnosis.effects.effect import Parameter
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.held_out import information
from diagnosis.predict import predicted_residuals

Array = NDArray[np.float64]

_Z95 = 1.959964
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


def intervals(
    evidence: Evidence, fit: Fit, change: Sequence[Mapping[str, Array]]
) -> dict[str, dict[str, Interval]]:
    """By effect and parameter, nuisance included.

    Args:
      change: of the prediction with a finer replay, over noise, by trial and sensor.
    """
    if fit.x.size == 0:
        return {}
    inverse = np.asarray(np.linalg.pinv(information(fit)), float)
    again = _shifts(evidence, fit, inverse)
    finer = _answer(fit, inverse, [np.concatenate([*c.values(), _NOTHING]) for c in change])
    spread = np.sqrt(np.diag(inverse) + np.mean(again**2, axis=0) + finer**2)
    coordinates = fit.coordinates
    low, high = coordinates.bounds()
    ends = [np.clip(fit.x + s * _Z95 * spread, low, high) for s in (-1, 1)]
    values = [coordinates.values(x) for x in (fit.x, *ends)]
    found: dict[str, dict[str, Interval]] = {}
    each = zip(coordinates.owners, coordinates.parameters, *values, strict=True)
    for owner, parameter, value, one, other in each:
        if parameter.reported:
            found.setdefault(owner, {})[parameter.name] = _interval(parameter, value, one, other)
    return found


def _interval(parameter: Parameter, value: float, one: float, other: float) -> Interval:
    """An angle is told in the half periods about 0."""
    period = parameter.period
    turns = period * round(value / period) if period else 0.0
    low, high = min(one, other) - turns, max(one, other) - turns
    return Interval(value=value - turns, low=low, high=high, unit=parameter.unit)


def _shifts(evidence: Evidence, fit: Fit, inverse: Array) -> Array:
    """How far the fit moves with the noise that is left in the base angle, (K, n)."""
    rng = np.random.default_rng(_SEED)
    rig = fit.coordinates.rig(fit.x)
    found = []
    for _ in range(_REPLICATES):
        runs = predicted_residuals(_noisier(evidence, rng), [rig])
        moved = [run[0] - residual for run, residual in zip(runs, fit.by_trial, strict=True)]
        found.append(_answer(fit, inverse, moved))
    return np.array(found)


def _answer(fit: Fit, inverse: Array, moved: Sequence[Array]) -> Array:
    """How far a fit moves when its residuals do, (n,)."""
    pull = sum(slopes.T @ change for slopes, change in zip(fit.jacobian, moved, strict=True))
    return np.asarray(-inverse @ pull)


def _noisier(evidence: Evidence, rng: np.random.Generator) -> Evidence:
    """The evidence, its base angles measured once more."""
    sigma = evidence.noise["base_angle_deg"]
    trials = []
    for trial in evidence.log.trials:
        angle = trial["base_angle_deg"]
        read = trial.table.assign(base_angle_deg=angle + rng.normal(0.0, sigma, angle.size))
        again = smoothed(replace(trial, table=read), sigma)
        trials.append(replace(trial, table=read.assign(base_angle_deg=again)))
    return replace(evidence, log=replace(evidence.log, trials=tuple(trials)))

"""Fitting a set of effects to a log, with what is never known of a rig left open.

Minimised is

    sum over trials and sensors ((measured - predicted) / noise)^2 + prior

by MuJoCo's own box-bounded Gauss-Newton; candidates of one Jacobian run as a batch.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray

from diagnosis.coordinates import Coordinates, coordinates_of
from diagnosis.effects import LIBRARY
from diagnosis.evidence import Evidence
from diagnosis.predict import predicted_residuals
from sim.simulation import SimulationFailed

Array = NDArray[np.float64]

_FAR = 0.1  # of the effects' entries, after which the slopes of the nuisance are taken again
_ENOUGH = 0.02  # a gradient that is less than this, in noise, is none


@dataclass(frozen=True, kw_only=True)
class Fit:
    """A fitted set of effects.

    Attributes:
      names: of the effects.
      x: the vector, `coordinates` says what it means.
      by_trial: residuals over noise, one array a trial.
      jacobian: d residual / d x, one (N, n) array a trial.
      cost: sum of squares with the prior.
    """

    names: tuple[str, ...]
    coordinates: Coordinates
    x: Array
    by_trial: tuple[Array, ...]
    jacobian: tuple[Array, ...]
    cost: float

    @property
    def samples(self) -> int:
        """Residuals in all."""
        return sum(r.size for r in self.by_trial)

    @property
    def gap(self) -> float:
        """Root mean square residual over noise, on the data of the fit."""
        return float(np.sqrt(sum(float(r @ r) for r in self.by_trial) / max(self.samples, 1)))

    @property
    def size(self) -> int:
        """Parameters that the named effects have."""
        return sum(len(LIBRARY[n].reported) for n in self.names)

    @property
    def parts(self) -> dict[str, Array]:
        """The vector by effect."""
        return self.coordinates.parts(self.x)


class Objective:
    """Residuals of a log as a function of the fit's vector, for `mujoco.minimize`.

    The nuisance moves by a few per cent at the most: its slopes are taken again only
    where the effects have moved far.

    Attributes:
      difference: that slopes are taken over.
      slopes: the last Jacobian that was taken, (N, n).
    """

    def __init__(self, evidence: Evidence, coordinates: Coordinates, difference: float = 1e-3) -> None:
        self.evidence, self.coordinates = evidence, coordinates
        self.difference = difference
        self.low, self.high = coordinates.bounds()
        self.slopes: Array | None = None
        self._fresh_at: Array | None = None
        self._rows: int | None = None

    def __call__(self, x: Array) -> Array:
        """(n, M) or (n,) to residuals with the prior, (N, M) or (N,)."""
        columns = x.reshape(x.shape[0], -1)
        rigs = [self.coordinates.rig(x) for x in columns.T]
        try:
            trials = predicted_residuals(self.evidence, rigs)
        except SimulationFailed:
            if self._rows is None or columns.shape[1] > 1:
                raise
            return np.full((self._rows, *x.shape[1:]), np.nan)  # a step too far: it is taken back
        rows = [
            np.concatenate([*(t[i] for t in trials), self.coordinates.weights * columns[:, i]])
            for i in range(columns.shape[1])
        ]
        self._rows = rows[0].size
        return np.stack(rows, axis=-1).reshape(-1, *x.shape[1:])

    def jacobian(self, x: Array, at_x: Array) -> Array:
        """By differences away from the bounds, (N, n)."""
        flat = x.ravel()
        steps = np.where(flat + self.difference > self.high, -1.0, 1.0) * self.difference
        taken = np.arange(self.coordinates.free)
        slopes = np.zeros((at_x.size, flat.size)) if self.slopes is None else np.array(self.slopes)
        if self._fresh_at is None or np.abs(flat - self._fresh_at)[taken].max(initial=0.0) > _FAR:
            taken, self._fresh_at = np.arange(flat.size), flat
        if taken.size:
            moved = self(flat[:, None] + np.diag(steps)[:, taken])
            slopes[:, taken] = (moved - at_x.reshape(-1, 1)) / steps[taken]
        self.slopes = slopes
        return slopes


def fit_effects(
    evidence: Evidence,
    names: Sequence[str],
    start: Array | None = None,
    *,
    most_iterations: int = 20,
) -> Fit:
    """Fit a set of effects.

    Args:
      start: the vector to start from; None is neutral.
      most_iterations: of Gauss-Newton.

    Raises:
      SimulationFailed: a candidate cannot be simulated.
    """
    coordinates = coordinates_of(names, evidence.nuisance)
    objective = Objective(evidence, coordinates)
    if not coordinates.parameters:
        return _fit(objective, names, np.zeros(0), np.zeros((0, 0)))
    x = np.clip(coordinates.joined({}) if start is None else start, objective.low, objective.high)
    for difference in max((e.differences for e in coordinates.all), key=len):
        objective = Objective(evidence, coordinates, difference)
        x = _descended(objective, x, most_iterations)
    slopes = objective.slopes
    return _fit(objective, names, x, np.zeros((0, 0)) if slopes is None else slopes)


def _descended(objective: Objective, start: Array, most_iterations: int) -> Array:
    """Where Gauss-Newton comes to from a start."""
    x, _ = minimize.least_squares(
        start,
        objective,
        bounds=[objective.low, objective.high],
        jacobian=objective.jacobian,
        x_scale="jac",
        gtol=_ENOUGH,
        xtol=1e-5,
        max_iter=most_iterations,
        mu_min=1e-3,
        mu_factor=8.0,
        verbose=minimize.Verbosity.SILENT,
    )
    return np.asarray(x).ravel()


def _fit(objective: Objective, names: Sequence[str], x: Array, slopes: Array) -> Fit:
    """The fit at x; its slopes are those of the last iterate."""
    trials = predicted_residuals(objective.evidence, [objective.coordinates.rig(x)])
    by_trial = tuple(t[0] for t in trials)
    ends = np.cumsum([r.size for r in by_trial])
    prior = objective.coordinates.weights * x
    whole = slopes if x.size else np.zeros((ends[-1], 0))
    return Fit(
        names=tuple(names),
        coordinates=objective.coordinates,
        x=x,
        by_trial=by_trial,
        jacobian=tuple(np.split(whole[: ends[-1]], ends[:-1])),
        cost=sum(float(r @ r) for r in by_trial) + float(prior @ prior),
    )

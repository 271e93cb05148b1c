"""Fitting a set of effects to a log, with the rig's own scatter as a nuisance.

Stiffness and damping of a rig are never exactly nominal. Unless they are among the
effects that are fitted, both may scatter by a few per cent (a prior of 1.5 %),
which is marginalised with the rest. Minimised is

    sum over trials and sensors ((measured - predicted) / noise)^2 + prior

by MuJoCo's own box-bounded Gauss-Newton; candidates of one Jacobian run as a batch.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Parameter
from diagnosis.noise import Noise
from diagnosis.predict import predict, residuals
from diagnosis.rig_log import RigLog
from diagnosis.rig_model import RigModel

Array = NDArray[np.float64]

NUISANCE = ("stiffness_error", "damping_error")
NUISANCE_SPREAD = 0.015
_STEP = 1e-3  # of finite differences, in the units of the fit
_MOST_ITERATIONS = 12


@dataclass(frozen=True, kw_only=True)
class Coordinates:
    """Parameters of a set of effects as a vector that a fit can move in."""

    effects: tuple[Effect, ...]
    nuisance: tuple[Effect, ...]

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Of all effects, then of the nuisance."""
        return tuple(p for e in (*self.effects, *self.nuisance) for p in e.parameters)

    def bounds(self) -> tuple[Array, Array]:
        """Lowest and highest vector."""
        low = [_forward(p, p.low) for p in self.parameters]
        high = [_forward(p, p.high) for p in self.parameters]
        return np.array(low), np.array(high)

    def starts(self) -> list[Array]:
        """Vectors to start from: the starts of the effect with most of them."""
        count = max([len(p.start) for e in self.effects for p in e.parameters] or [1])
        own = [p for e in self.effects for p in e.parameters]
        starts = []
        for i in range(count):
            values = [_forward(p, p.start[i % len(p.start)]) for p in own]
            starts.append(np.array(values + [0.0] * len(self.nuisance)))
        return starts

    def values(self, x: Array) -> list[float]:
        """Parameter values of a vector."""
        return [_backward(p, float(v)) for p, v in zip(self.parameters, x, strict=True)]

    def rig(self, x: Array) -> RigModel:
        """The rig with these effects in it."""
        rig, values = RigModel(), self.values(x)
        for effect in (*self.effects, *self.nuisance):
            count = len(effect.parameters)
            rig = effect.enter(rig, *values[:count])
            values = values[count:]
        return rig

    def prior(self, x: Array) -> Array:
        """Residuals of the prior: the nuisance scatters by a few per cent."""
        count = len(self.nuisance)
        return x[x.size - count :] / NUISANCE_SPREAD if count else np.zeros(0)


def _forward(p: Parameter, value: float) -> float:
    return float(np.log(value)) if p.logarithmic else value / _scale(p)


def _backward(p: Parameter, x: float) -> float:
    return float(np.exp(x)) if p.logarithmic else x * _scale(p)


def _scale(p: Parameter) -> float:
    """Linear parameters are fitted in units of this."""
    return {"deg": 10.0 if p.name == "phase" else 1.0, "s": 0.1, "N mm": 0.05}.get(p.unit, 1.0)


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
        return sum(len(LIBRARY[n].parameters) for n in self.names)


def coordinates_of(names: Sequence[str], *, nuisance: bool = True) -> Coordinates:
    """The coordinates of a set of effects by name."""
    others = tuple(LIBRARY[n] for n in NUISANCE if n not in names) if nuisance else ()
    return Coordinates(effects=tuple(LIBRARY[n] for n in names), nuisance=others)


class Objective:
    """Residuals of a log as a function of the fit's vector."""

    def __init__(self, log: RigLog, noise: Noise, coordinates: Coordinates) -> None:
        self.log, self.noise, self.coordinates = log, noise, coordinates

    def by_trial(self, columns: Array) -> list[list[Array]]:
        """Residuals of every column, (n, M): trial by trial, then column by column."""
        rigs = [self.coordinates.rig(x) for x in columns.T]
        found = []
        for trial in self.log.trials:
            predictions = predict(self.log, trial, rigs)
            found.append([residuals(trial, p, self.noise) for p in predictions])
        return found

    def __call__(self, x: Array) -> Array:
        """For `mujoco.minimize`: (n, M) or (n,) to residuals, (N, M) or (N,)."""
        columns = x.reshape(x.shape[0], -1)
        trials = self.by_trial(columns)
        rows = [
            np.concatenate([*(t[i] for t in trials), self.coordinates.prior(columns[:, i])])
            for i in range(columns.shape[1])
        ]
        return np.stack(rows, axis=-1).reshape(-1, *x.shape[1:])


def fit_effects(
    log: RigLog,
    noise: Noise,
    names: Sequence[str],
    *,
    nuisance: bool = True,
    most_iterations: int = _MOST_ITERATIONS,
    start: Array | None = None,
) -> Fit:
    """Fit a set of effects; of several starts the best is gone on from.

    Args:
      nuisance: let stiffness and damping scatter, where they are not among the effects.
      most_iterations: of the fit.
      start: where to start instead of the effects' own starts.
    """
    coordinates = coordinates_of(names, nuisance=nuisance)
    objective = Objective(log, noise, coordinates)
    if not coordinates.parameters:
        return _finished(objective, names, np.zeros(0))
    low, high = coordinates.bounds()
    starts = coordinates.starts() if start is None else [start]
    columns = np.stack([np.clip(s, low, high) for s in starts], axis=-1)
    costs = (objective(columns) ** 2).sum(axis=0)
    best = columns[:, int(np.argmin(costs))]
    x, _ = minimize.least_squares(
        best,
        objective,
        bounds=[low, high],
        eps=_STEP,
        max_iter=most_iterations,
        mu_min=1e-3,
        mu_factor=8.0,
        gtol=1e-4,
        xtol=1e-4,
        verbose=minimize.Verbosity.SILENT,
    )
    return _finished(objective, names, np.asarray(x).ravel())


def _finished(objective: Objective, names: Sequence[str], x: Array) -> Fit:
    """Residuals and Jacobian at the end."""
    n = x.size
    _, high = objective.coordinates.bounds()
    steps = _STEP * np.where(x + _STEP > high, -1.0, 1.0)
    columns = np.concatenate([x[:, None], x[:, None] + np.diag(steps)], axis=1)
    trials = objective.by_trial(columns)
    by_trial = tuple(t[0] for t in trials)
    jacobian = tuple(
        np.stack([(t[i + 1] - t[0]) / steps[i] for i in range(n)], axis=-1)
        if n
        else np.zeros((t[0].size, 0))
        for t in trials
    )
    prior = objective.coordinates.prior(x)
    cost = sum(float(r @ r) for r in by_trial) + float(prior @ prior)
    return Fit(
        names=tuple(names),
        coordinates=objective.coordinates,
        x=x,
        by_trial=by_trial,
        jacobian=jacobian,
        cost=cost,
    )

"""A parameter with a value of its own in each trial: a rig that was changed or zeroed between them.

In the linear model of a fit, with residuals r and slopes J, among them those of the offsets of sensors
that it lacks, one parameter p is free in each trial t, while all others are common:

    minimise over y and d   sum over t |r_t + J_t y + j_t d_t|^2 + prior,    j: column of p in J

What that leaves, beside what is left if p is common too, tells whether the trials differ in p. The
model is linear, so a value far from the common one shows the direction more than the size; it takes no
simulations but those of the offsets.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import DIFFERING_SHARE
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.bounded_least_squares import bounded_least_squares
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]

OFFSETS = ("torque_bias", "tip_angle_bias")
_STEP = 1e-2  # in the units of a fit; readings are linear in an offset
_RIDGE = 1e-12  # relative: a trial that does not tell keeps the common value


@dataclass(frozen=True, kw_only=True)
class ValuesByTrial:
    """A parameter of the nearest explanation, with a value of its own in each trial.

    Attributes:
      effect, parameter, unit: as in the vocabulary.
      values: by trial; None: over its whole range it changes no more than noise in the trial.
      gap_common: rms of residual / sigma that the linear model leaves on all trials; gap_own: with these
        values.
    """

    effect: str
    parameter: str
    unit: str
    values: tuple[float | None, ...]
    gap_common: float
    gap_own: float

    @property
    def differs(self) -> bool:
        """Whether the values account for a good part of what the common one leaves beyond noise."""
        beyond = self.gap_common**2 - 1.0
        return beyond > 0.0 and self.gap_common**2 - self.gap_own**2 >= DIFFERING_SHARE * beyond


def values_by_trial(problem: FitProblem, fit: Fit) -> tuple[ValuesByTrial, ...]:
    """Every reported parameter of a fit, and every offset of a sensor; what leaves least first.

    Empty where there is one trial, or nothing was fitted.

    Raises:
      SimulationFailed: the rig of the fit cannot be simulated with an offset.
    """
    if len(problem.log.trials) < 2 or not fit.names:
        return ()
    model = _model_of(problem, fit)
    own = model.parameterization
    each = enumerate(zip(own.owners, own.parameters, strict=True))
    told = [
        _values(model, i, owner, p)
        for i, (owner, p) in each
        if owner in LIBRARY and p.reported and p.neutral is not None
    ]
    seen = [one for one in told if any(value is not None for value in one.values)]
    return tuple(sorted(seen, key=lambda one: one.gap_own))


@dataclass(frozen=True, kw_only=True, eq=False)
class _Model:
    """The linear model, with sums over the rows of each trial.

    Attributes:
      x: the vector of the fit, with offsets at zero, (m,).
      grams: slopes' slopes, (trials, m, m); seen: slopes' residual, (trials, m).
      cost: sum of squares of residuals, without the prior.
      samples: number of residuals.
    """

    parameterization: Parameterization
    x: Array
    grams: Array
    seen: Array
    cost: float
    samples: int

    def left(self, matrix: Array, wanted: Array, low: Array, high: Array) -> tuple[Array, float]:
        """The step, (k,), that minimises y' matrix y - 2 wanted' y, and the gap that it leaves."""
        scale = 1.0 / np.sqrt(np.diag(matrix) + np.finfo(float).tiny)
        scaled = scale[:, None] * matrix * scale + _RIDGE * np.eye(scale.size)
        root = np.asarray(np.linalg.cholesky(scaled, upper=True), np.float64)
        aim = np.asarray(np.linalg.solve(root.T, scale * wanted), np.float64)
        step = bounded_least_squares(root, aim, low / scale, high / scale)
        reduction = float(aim @ aim - np.sum((root @ step - aim) ** 2))
        return scale * step, float(np.sqrt(max(self.cost - reduction, 0.0) / self.samples))


def _model_of(problem: FitProblem, fit: Fit) -> _Model:
    """The linear model of a fit, beside the offsets that it lacks."""
    more = [name for name in OFFSETS if name not in fit.parameterization.owners]
    own = problem.parameterization((*fit.names, *more))
    x = own.joined(fit.parts)
    added = [i for i, owner in enumerate(own.owners) if owner in more]
    rigs = [own.rig(x), *(own.rig(x + _STEP * unit) for unit in np.eye(x.size)[added])]
    runs = problem.residuals(rigs, callback_alone=True)
    slopes = []
    for jacobian, run in zip(fit.jacobian, runs, strict=True):
        whole = np.zeros((run[0].size, x.size))
        whole[:, [i for i in range(x.size) if i not in added]] = jacobian
        whole[:, added] = np.stack([r - run[0] for r in run[1:]], axis=1) / _STEP if added else 0.0
        slopes.append(whole)
    pairs = list(zip(slopes, fit.by_trial, strict=True))
    return _Model(
        parameterization=own,
        x=x,
        grams=np.array([c.T @ c for c, _ in pairs]),
        seen=np.array([c.T @ r for c, r in pairs]),
        cost=sum(float(r @ r) for _, r in pairs),
        samples=fit.samples,
    )


def _values(model: _Model, i: int, owner: str, parameter: Parameter) -> ValuesByTrial:
    """What each trial says of the entry i."""
    own, x = model.parameterization, model.x
    low, high = (bound - x for bound in own.bounds())
    prior = own.weights**2
    matrix, wanted = model.grams.sum(axis=0) + np.diag(prior), -model.seen.sum(axis=0) - prior * x
    _, common = model.left(matrix, wanted, low, high)
    others = np.arange(x.size) != i
    cross, square = model.grams[:, others, i], model.grams[:, i, i]
    free = np.block([[matrix[np.ix_(others, others)], cross.T], [cross, np.diag(square)]])
    aims = np.concatenate([wanted[others], -model.seen[:, i]])
    ends = (np.concatenate([b[others], np.full(square.size, b[i])]) for b in (low, high))
    step, gap = model.left(free, aims, *ends)
    values = [parameter.from_fit(float(x[i] + d)) for d in step[others.sum() :]]
    tells = square * (high[i] - low[i]) ** 2 > 1.0
    return ValuesByTrial(
        effect=owner,
        parameter=parameter.name,
        unit=parameter.unit,
        values=tuple(v if seen else None for v, seen in zip(values, tells, strict=True)),
        gap_common=common,
        gap_own=gap,
    )

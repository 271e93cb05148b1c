"""A parameter with a value of its own in each part of a log: in each trial, or each motion of the base.

A rig may have been changed, or a sensor zeroed, between trials; friction may depend on the direction of
turning; and at rest a servo may hold less than friction does. In the linear model of a fit, with
residuals r and slopes J, among them those of the offsets of sensors that it lacks, one parameter p is
free in each part k of the rows, while all others are common:

    minimise over y and d   sum over parts k |r_k + J_k y + j_k d_k|^2 + prior,    j: column of p in J

What that leaves, beside what is left if p is common too, tells whether the parts differ in p. The model
is linear, so a value far from the common one shows the direction more than the size; and a reading
counts to the part in which it was taken, whatever was before. It takes no simulations but those of the
offsets.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.uncertainty.partitions import Partition
from diagnosis.criteria.assessment import DIFFERING_SHARE
from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.fitting.bounded_least_squares import bounded_least_squares
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.parameterization import Parameterization
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]

OFFSETS = ("torque_bias", "tip_angle_bias")
_STEP = 1e-2  # in the units of a fit; readings are linear in an offset
_RIDGE = 1e-12  # relative: a part that does not tell keeps the common value


@dataclass(frozen=True, kw_only=True)
class ValuesByPart:
    """A parameter of the nearest explanation, with a value of its own in each part of a log.

    Attributes:
      effect, parameter, unit: as in the vocabulary.
      parts: names of the parts.
      values: by part; None: over its whole range it changes no more than noise there.
      gap_common: rms of residual / sigma that the linear model leaves of the log; gap_own: with these
        values.
    """

    effect: str
    parameter: str
    unit: str
    parts: tuple[str, ...]
    values: tuple[float | None, ...]
    gap_common: float
    gap_own: float

    @property
    def share(self) -> float:
        """Share of the power beyond noise that these values take off what the common one leaves.

        Of what is within the limits of noise, it is the share of that limit.
        """
        beyond = max(self.gap_common, GAP_LIMIT) ** 2 - 1.0
        return (self.gap_common**2 - self.gap_own**2) / beyond

    @property
    def differs(self) -> bool:
        """Whether that is more than what a law that is missing mostly does, as motions differ."""
        return self.share >= DIFFERING_SHARE


def values_by_part(
    problem: FitProblem, fit: Fit, *partitions: Partition
) -> tuple[tuple[ValuesByPart, ...], ...]:
    """Every reported parameter of a fit, and every offset of a sensor, by parts; the best first.

    A log of one part has none, nor has a fit of nothing.

    Raises:
      SimulationFailed: the rig of the fit cannot be simulated with an offset.
    """
    if not fit.names or all(len(own.names) < 2 for own in partitions):
        return ((),) * len(partitions)
    columns = _columns(problem, fit)
    return tuple(_of_partition(columns, fit, own) if len(own.names) > 1 else () for own in partitions)


@dataclass(frozen=True, kw_only=True, eq=False)
class _Columns:
    """The slopes of a fit, beside those of the offsets that it lacks.

    Attributes:
      x: the vector of the fit, with offsets at zero, (m,).
      slopes: by trial, (N, m).
    """

    parameterization: Parameterization
    x: Array
    slopes: tuple[Array, ...]


def _columns(problem: FitProblem, fit: Fit) -> _Columns:
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
    return _Columns(parameterization=own, x=x, slopes=tuple(slopes))


def _of_partition(columns: _Columns, fit: Fit, parts: Partition) -> tuple[ValuesByPart, ...]:
    model, own = _model_of(columns, fit, parts), columns.parameterization
    each = enumerate(zip(own.owners, own.parameters, strict=True))
    told = [
        _values(model, parts, i, owner, p)
        for i, (owner, p) in each
        if owner in LIBRARY and p.reported and p.neutral is not None
    ]
    seen = [one for one in told if any(value is not None for value in one.values)]
    return tuple(sorted(seen, key=lambda one: one.gap_own))


@dataclass(frozen=True, kw_only=True, eq=False)
class _Model:
    """The linear model, with sums over the rows of each part.

    Attributes:
      x: the vector of the fit, with offsets at zero, (m,).
      grams: slopes' slopes, (parts, m, m); seen: slopes' residual, (parts, m).
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


def _model_of(columns: _Columns, fit: Fit, parts: Partition) -> _Model:
    slopes, left = np.vstack(columns.slopes), np.concatenate(fit.by_trial)
    of_rows = np.concatenate(parts.of_rows)
    pairs = [(slopes[of_rows == k], left[of_rows == k]) for k in range(len(parts.names))]
    return _Model(
        parameterization=columns.parameterization,
        x=columns.x,
        grams=np.array([c.T @ c for c, _ in pairs]),
        seen=np.array([c.T @ r for c, r in pairs]),
        cost=float(left @ left),
        samples=fit.samples,
    )


def _values(model: _Model, parts: Partition, i: int, owner: str, parameter: Parameter) -> ValuesByPart:
    """What each part says of the entry i."""
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
    return ValuesByPart(
        effect=owner,
        parameter=parameter.name,
        unit=parameter.unit,
        parts=parts.names,
        values=tuple(v if seen else None for v, seen in zip(values, tells, strict=True)),
        gap_common=common,
        gap_own=gap,
    )

"""The joint uncertainty of the parameters of a fit.

The uncertainty of two parameters is an ellipse, not a rectangle: if they are correlated, one may be
larger if the other is smaller. In 95 of 100 logs both lie within

    (x - fit)' C^-1 (x - fit) = -2 log(1 - 0.95).

C is the covariance of the two in the units of the fit; a parameter that is fitted in its logarithm
bends the ellipse.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.assessment import CONFIDENCE
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter, slopes_at
from diagnosis.fitting.fit import Fit

Array = NDArray[np.float64]

_POINTS = 121


@dataclass(frozen=True, kw_only=True, eq=False)
class JointUncertainty:
    """Parameters with their covariance.

    Attributes:
      owners: effect of each parameter.
      x: values, (n,); with `covariance`, (n, n), in the units of the fit.
    """

    owners: tuple[str, ...]
    parameters: tuple[Parameter, ...]
    x: Array
    covariance: Array

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameters, as effect.parameter."""
        return tuple(f"{o}.{p.name}" for o, p in zip(self.owners, self.parameters, strict=True))

    @property
    def values(self) -> Array:
        """Values in the units of the parameters, (n,)."""
        return np.array([p.from_fit(float(v)) for p, v in zip(self.parameters, self.x, strict=True)])

    @property
    def told(self) -> Array:
        """Values as in a report, (n,): angles are within half a period of 0."""
        each = zip(self.parameters, self.values, strict=True)
        return np.array([value - p.turns(float(value)) for p, value in each])

    @property
    def covariance_of_values(self) -> Array:
        """Covariance in the units of the parameters, (n, n): that of the fit times slopes."""
        slopes = slopes_at(self.parameters, self.x)
        return np.asarray(slopes[:, None] * self.covariance * slopes)

    def correlation(self, i: int, j: int) -> float:
        """Correlation of two parameters, -1 to 1; 0 if one of them is certain."""
        product = float(self.covariance[i, i] * self.covariance[j, j])
        return float(self.covariance[i, j]) / math.sqrt(product) if product > 0 else 0.0

    def ellipse(self, i: int, j: int) -> Array:
        """Outline of the 95 % region of two parameters within their bounds, in their units, (2, N)."""
        own = np.ix_([i, j], [i, j])
        size, axes = np.linalg.eigh(self.covariance[own])
        angle = np.linspace(0.0, 2.0 * np.pi, _POINTS)
        radius = math.sqrt(-2.0 * math.log(1.0 - CONFIDENCE))
        circle = (
            radius * np.sqrt(np.maximum(size, 0.0))[:, None] * np.stack([np.cos(angle), np.sin(angle)])
        )
        outline = self.x[[i, j], None] + axes @ circle
        both = (self.parameters[i], self.parameters[j])
        return np.array([_within(p, row) for p, row in zip(both, outline, strict=True)])


def _within(parameter: Parameter, row: Array) -> list[float]:
    """Values of coordinates of a fit, (N,); those beyond a bound are at it."""
    inside = np.clip(row, parameter.to_fit(parameter.low), parameter.to_fit(parameter.high))
    return [parameter.from_fit(float(v)) for v in inside]


def joint_uncertainty(fit: Fit, spread: Array, effects: Sequence[str]) -> JointUncertainty:
    """Joint uncertainty of the reported parameters of effects, then of nuisance parameters.

    Args:
      spread: covariance of the vector of the fit, (n, n).
    """
    every = fit.parameterization
    constants = [e.name for e in every.nuisance if e.name in LIBRARY and e.name not in effects]
    entries = [
        i
        for name in (*effects, *constants)
        for i, owner in enumerate(every.owners)
        if owner == name and every.parameters[i].reported
    ]
    return JointUncertainty(
        owners=tuple(every.owners[i] for i in entries),
        parameters=tuple(every.parameters[i] for i in entries),
        x=fit.x[entries],
        covariance=spread[np.ix_(entries, entries)],
    )

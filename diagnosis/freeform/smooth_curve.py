"""Smooth curves whose coordinates are a priori independent and of size 1.

A curve is drawn from a Gaussian process at a few places: a constant, a straight line and a smooth part,

    cov(x, y) = 1 + u v + s exp(-(u - v)^2 / (2 l^2)),    u, v: x, y scaled to -1 ... 1,  l = 0.4, s = 0.1

(Rasmussen and Williams 2006, Section 2.7). With L L' = cov, values = scale L c for coordinates c that are
normal with a common standard deviation, the strength of the prior. What the data do not reach
goes on straight. A curve that has a period has
cov = 1 + exp(-2 sin^2((x - y) pi / period) / l^2), their Section 4.2.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LENGTH, _PERIODIC_LENGTH = 0.4, 0.9
_SMOOTH = 0.1
_JITTER = 1e-6


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothCurve:
    """A curve by its coordinates.

    Attributes:
      places: of the variable, increasing, (K,).
      basis: values at the places for each coordinate, (K, n).
      period: of the variable; 0: none.
    """

    places: Array
    basis: Array
    period: float = 0.0

    @property
    def size(self) -> int:
        """Coordinates."""
        return self.basis.shape[1]

    def values(self, coordinates: Sequence[float]) -> tuple[float, ...]:
        """At the places."""
        return tuple(float(v) for v in self.basis @ np.asarray(coordinates, float))


def smooth_curve(low: float, high: float, count: int = 8, *, fading: bool = False) -> SmoothCurve:
    """A curve between two ends of a variable.

    Args:
      fading: what happens near the low end may be faster: places are closer there, as squares.
    """
    u = np.linspace(-1.0, 1.0, count)
    share = (0.5 * (u + 1.0)) ** (2 if fading else 1)
    covariance = 1.0 + np.outer(u, u)
    covariance += _SMOOTH * np.exp(-((u[:, None] - u) ** 2) / (2 * _LENGTH**2))
    return SmoothCurve(places=low + (high - low) * share, basis=_root(covariance))


def periodic_curve(period: float, count: int = 8) -> SmoothCurve:
    """A curve that repeats."""
    places = np.arange(count) * period / count
    sine = np.sin((places[:, None] - places) * np.pi / period)
    covariance = 1.0 + np.exp(-2.0 * sine**2 / _PERIODIC_LENGTH**2)
    return SmoothCurve(places=places, basis=_root(covariance), period=period)


def two_values() -> SmoothCurve:
    """One value backwards, one forwards."""
    return SmoothCurve(places=np.array([-1.0, 1.0]), basis=np.eye(2))


def _root(covariance: Array) -> Array:
    return np.linalg.cholesky(covariance + _JITTER * np.eye(len(covariance)))

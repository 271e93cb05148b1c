"""Smooth curves whose coordinates are a priori independent.

A curve, by its values at a few places, is the sum of a straight line and a smooth rest,

    y = scale [a + b u + sum over k of c_k sqrt(lambda_k) v_k],    u: x scaled to -1 ... 1,

where lambda_k, v_k are eigenvalues and eigenvectors of a Gaussian process of covariance
exp(-(u - u')^2 / (2 l^2)), l = 0.4, orthogonal to straight lines (Rasmussen and Williams 2006, Section
2.7). A curve with a period is a constant and a rest of covariance exp(-2 sin^2((x - x') pi / period) /
l^2), their Section 4.2. Straight part and rest have separate prior strengths, so that a straight law
continues straight where no trial has been. If both signs of a variable may differ, |x| belongs to
the straight part.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from diagnosis.replay.curve import FACTORS, ActsOn, Curve
from diagnosis.replay.variables import Variable

Array = NDArray[np.float64]

_LENGTH, _PERIODIC_LENGTH = 0.4, 0.6
_NEXT_TO_ZERO = 1e-6  # of the range
_FARTHEST_LOG = 14.0  # of a factor: a millionth, or a million
_AT_REST = 0.02  # of the range: as slow as that is no rest


@dataclass(frozen=True, kw_only=True, eq=False)
class SmoothCurve:
    """A curve, given by its coordinates.

    Attributes:
      places: values of the variable, increasing, (K,).
      basis: values of the curve at the places for each coordinate, (K, n).
      straight: number of coordinates of the straight part (constant and slope), which come first.
      detail: number of those of a finer curve's detail, which come last.
      period: period of the variable; 0: none.
    """

    places: Array
    basis: Array
    straight: int
    detail: int = 0
    period: float = 0.0

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return int(self.basis.shape[1])

    def values(self, coordinates: Sequence[float]) -> tuple[float, ...]:
        """Values at the places, (K,)."""
        return tuple(float(v) for v in self.basis @ np.asarray(coordinates, float))

    def coordinates(self, values: ArrayLike) -> tuple[float, ...]:
        """Coordinates of the curve that comes nearest to values at the places, (K,)."""
        found, *_ = np.linalg.lstsq(self.basis, np.asarray(values, float))
        return tuple(float(c) for c in found)

    def factors(self, coordinates: Sequence[float]) -> tuple[float, ...]:
        """Exponentials of the values at the places, (K,): factors that are positive and finite."""
        within = np.clip(self.values(coordinates), -_FARTHEST_LOG, _FARTHEST_LOG)
        return tuple(float(v) for v in np.exp(within))

    @property
    def finer(self) -> "SmoothCurve":
        """The curve with places halfway between its own, and a coordinate of its detail at each.

        Its first coordinates are those of the curve as it is: with no detail its straight part is the
        same, and a cubic spline runs through its rest.
        """
        places, values = self.places, self.basis
        if self.period:
            places, values = np.append(places, places[0] + self.period), np.vstack([values, values[:1]])
        halfway = 0.5 * (places[1:] + places[:-1])
        own = np.sort(np.append(self.places, halfway))
        line = [np.interp(own, places, column) for column in values.T[: self.straight]]
        rest = CubicSpline(
            places, values[:, self.straight :], bc_type="periodic" if self.period else "not-a-knot"
        )
        detail = (own[:, None] == halfway).astype(float)
        basis = np.hstack([np.stack(line, axis=1), rest(own), detail])
        return replace(self, places=own, basis=basis, detail=self.detail + halfway.size)

    def zero_at_zero(self) -> "SmoothCurve":
        """The curve less its value where the variable is 0; as it is, if the places do not span 0.

        Its straight part begins with a constant, which falls away.
        """
        if not self.places[0] <= 0.0 <= self.places[-1]:
            return self
        at_zero = np.array([np.interp(0.0, self.places, column) for column in self.basis.T])
        return replace(self, basis=(self.basis - at_zero)[:, 1:], straight=self.straight - 1)

    def acting_on(self, acts_on: ActsOn, variable: Variable, coordinates: Sequence[float]) -> Curve:
        """The curve in a free law: of factors where it multiplies, else of values."""
        return Curve(
            acts_on=acts_on,
            variable=variable,
            places=tuple(float(x) for x in self.places),
            values=self.factors(coordinates) if acts_on in FACTORS else self.values(coordinates),
            period=self.period,
        )


def smooth_curve(low: float, high: float, count: int = 8, *, fading: bool = False) -> SmoothCurve:
    """A curve between two ends of a variable.

    Args:
      fading: changes near the low end may be faster: places are closer there, as squares.
    """
    u = np.linspace(-1.0, 1.0, count)
    share = (0.5 * (u + 1.0)) ** (2 if fading else 1)
    covariance = np.exp(-((u[:, None] - u) ** 2) / (2 * _LENGTH**2))
    line = np.stack([np.ones(count), u], axis=1)
    places = low + (high - low) * share
    return SmoothCurve(places=places, basis=_beside(line, covariance), straight=2)


def rough_curve(low: float, high: float, count: int) -> SmoothCurve:
    """A curve that may change from one place to the next, as from layer to layer: a random walk.

    Covariance exp(-|u - u'| / l) beside a straight line.
    """
    u = np.linspace(-1.0, 1.0, count)
    covariance = np.exp(-np.abs(u[:, None] - u) / _LENGTH)
    line = np.stack([np.ones(count), u], axis=1)
    return SmoothCurve(places=np.linspace(low, high, count), basis=_beside(line, covariance), straight=2)


def bent_curve(low: float, high: float, count: int = 8, *, close: bool = False) -> SmoothCurve:
    """A smooth curve that may bend at zero, where both signs of a variable may differ.

    Its straight part has one slope on each side. If the range has one sign only, it is a smooth curve.

    Args:
      close: changes near zero may be faster: places are closer there, as squares.
    """
    if not low < 0 < high:
        return smooth_curve(low, high, count)
    most, power = max(-low, high), 2.0 if close else 1.0
    at = np.linspace(-((-low / most) ** (1.0 / power)), (high / most) ** (1.0 / power), count)
    inner = at[1:-1]
    inner[np.argmin(np.abs(inner))] = 0.0
    u = np.copysign(np.abs(at) ** power, at)
    covariance = np.exp(-((at[:, None] - at) ** 2) / (2 * _LENGTH**2))
    line = np.stack([np.ones(count), u, np.abs(u)], axis=1)
    return SmoothCurve(places=most * u, basis=_beside(line, covariance), straight=3)


def jumping_curve(low: float, high: float, count: int = 9) -> SmoothCurve:
    """A curve whose values on both sides of zero, and at rest, have nothing to do with each other.

    Its straight part is a line on each side and a value of its own at zero. If the range has one sign
    only, there is a line on that side. Zero is always among the places.
    """
    sides = [(side, end) for side, end in ((-1.0, -low), (1.0, high)) if end > 0]
    each = max(count // len(sides), 3)
    away = np.concatenate([[_AT_REST], np.linspace(0.0, 1.0, each)[1:]])
    places = np.unique(np.concatenate([[0.0], *(side * end * away for side, end in sides)]))
    u = places / max(-low, high)
    on = [u * side > 0 for side, _ in sides]
    line = np.stack([u == 0, *on, *(own * u for own in on)], axis=1).astype(float)
    covariance = np.exp(-((u[:, None] - u) ** 2) / (2 * _LENGTH**2))
    covariance *= np.sign(u)[:, None] == np.sign(u)
    return SmoothCurve(places=places, basis=_beside(line, covariance), straight=line.shape[1])


def two_sided_curve(most: float, count: int) -> SmoothCurve:
    """A smooth curve of the size of a variable, and a jump and a slope that tell its signs apart.

    Args:
      count: places of either sign, from next to zero on, as squares: closer where a variable is small.
    """
    size = np.maximum(np.linspace(0.0, 1.0, count) ** 2, _NEXT_TO_ZERO)
    u = np.concatenate([-size[::-1], size])
    size = np.abs(u)
    line = np.stack([np.ones(u.size), size, np.sign(u), u], axis=1)
    covariance = np.exp(-((size[:, None] - size) ** 2) / (2 * _LENGTH**2))
    basis = _beside(line, covariance)
    even = basis[:, -(count - 2) :]  # of the others, the process has none
    return SmoothCurve(places=most * u, basis=np.hstack([line, even]), straight=4)


def periodic_curve(period: float, count: int = 12) -> SmoothCurve:
    """A curve that repeats after a period."""
    places = np.arange(count) * period / count
    sine = np.sin((places[:, None] - places) * np.pi / period)
    covariance = np.exp(-2.0 * sine**2 / _PERIODIC_LENGTH**2)
    basis = _beside(np.ones((count, 1)), covariance)
    return SmoothCurve(places=places, basis=basis, straight=1, period=period)


def two_values() -> SmoothCurve:
    """One value for the backward direction (-1), one for the forward direction (1)."""
    line = np.array([[1.0, -1.0], [1.0, 1.0]])
    return SmoothCurve(places=np.array([-1.0, 1.0]), basis=line, straight=2)


def three_values() -> SmoothCurve:
    """One value for each direction (-1 and 1), one for where neither is reached yet (0)."""
    line = np.array([[1.0, -1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 1.0, 0.0]])
    return SmoothCurve(places=np.array([-1.0, 0.0, 1.0]), basis=line, straight=3)


def separate_values(places: Array) -> SmoothCurve:
    """Values at the places that are independent of each other."""
    return SmoothCurve(places=places, basis=np.eye(places.size), straight=0)


def _beside(line: Array, covariance: Array) -> Array:
    """A straight part, and the part of a process that is orthogonal to it, as columns."""
    onto = line @ np.linalg.pinv(line)
    rest = np.eye(len(line)) - onto
    values, vectors = np.linalg.eigh(rest @ covariance @ rest)
    kept = slice(line.shape[1], None)  # eigenvalues rise; those of the line are 0
    return np.hstack([line, vectors[:, kept] * np.sqrt(np.maximum(values[kept], 0.0))])

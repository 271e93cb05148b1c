"""Slow drift of a sensor: a random walk, and the part of a residual that it may explain.

Within a trial of length T the drift is modelled as

    a + b (t / T) + sum over k of c_k (cos(pi k t / T) - 1),    b, c_k k ~ N(0, D),  a ~ N(0, 3 D)

which is the spectrum of a random walk; D is its size, and a its value at the start: 0 of a sensor that
is zeroed before every trial. Let G be these shapes at the samples, times the size of each, whitened as
the noise asks. With the drift's covariance G G' added to that of white noise, a residual r in units of
sigma becomes white by

    r - U (1 - 1 / sqrt(1 + L)) U' r,    G = U sqrt(L) V'

so that drift does not influence a fit; constants, and fast changes of the same size, hardly do;
residuals that are larger or faster than drift count as before. What allowing for it costs, in
-2 log(likelihood), is the sum of log(1 + L).
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.noise import DRIFT_FASTEST_S, DRIFT_MOST_SHAPES, DRIFT_SIZE_OF_FASTEST
from diagnosis.prepare.noise.colour import Colour

Array = NDArray[np.float64]

_ROUNDING = 1e-13  # of the largest square, of sums over as many samples
_BEFORE = 3.0  # what a drift may have come to before a trial, in its size within one
_KEPT = 32  # trials whose shapes are kept: a fit asks thousands of times for the same


@dataclass(frozen=True, kw_only=True)
class AllowedDrift:
    """Drift that a sensor may have, in the unit of its readings.

    Attributes:
      size: D, of a random walk within a trial.
      zeroed: whether it begins at zero in every trial.
    """

    size: float
    zeroed: bool = False


@dataclass(frozen=True, kw_only=True)
class Drift:
    """Drift of a sensor whose readings are in units of its noise.

    Attributes:
      size_sigma: D, of a random walk within a trial.
      zeroed: whether it begins at zero in every trial.
      colour: of the noise beside it; None: white.
    """

    size_sigma: float
    zeroed: bool = False
    colour: Colour | None = None

    def whitened(self, time_s: Array, values: Array) -> Array:
        """Residuals without what may be drift, (N,) or (N, n).

        Args:
          time_s: times of the samples that were read, (N,).
          values: residuals / sigma, whitened as the colour of the noise asks.
        """
        directions, squares = _directions(self, time_s.tobytes())
        return _scaled(values, directions, 1.0 / np.sqrt(1.0 + squares))

    def restored(self, time_s: Array, whitened: Array) -> Array:
        """The inverse of `whitened`."""
        directions, squares = _directions(self, time_s.tobytes())
        return _scaled(whitened, directions, np.sqrt(1.0 + squares))

    def uncertainty(self, time_s: Array) -> float:
        """What allowing for it costs, in -2 log(likelihood)."""
        return float(np.log1p(_directions(self, time_s.tobytes())[1]).sum())

    def likeliest(self, time_s: Array, left: Array) -> Array:
        """The likeliest drift in a residual / sigma, at all its samples, (N,); NaN are left out."""
        sizes, _ = self._sizes(time_s, left)
        return np.asarray(_shapes(time_s, self) @ sizes)

    def start(self, time_s: Array, left: Array) -> float:
        """The likeliest drift at the beginning, in standard deviations of this estimate."""
        sizes, covariance = self._sizes(time_s, left)
        first = _shapes(time_s, self)[0]
        spread = float(np.sqrt(first @ covariance @ first))
        return float(first @ sizes) / spread if spread > 0.0 else 0.0

    def _sizes(self, time_s: Array, left: Array) -> tuple[Array, Array]:
        """Likeliest sizes of the shapes in a residual / sigma, (K,), and their covariance."""
        read = np.isfinite(left)
        seen, told = _shapes(time_s, self)[read], left[read]
        if self.colour:
            seen, told = (self.colour.whitened(time_s[read], own) for own in (seen, told))
        covariance = np.asarray(np.linalg.inv(seen.T @ seen + np.eye(seen.shape[1])), float)
        return covariance @ (seen.T @ told), covariance


def _scaled(values: Array, directions: Array, factors: Array) -> Array:
    """Values with their parts along some directions multiplied by factors."""
    along = directions.T @ values
    change = (factors - 1.0).reshape(-1, *[1] * (values.ndim - 1))
    return np.asarray(values + directions @ (change * along))


@lru_cache(maxsize=_KEPT)
def _directions(drift: Drift, time_s: bytes) -> tuple[Array, Array]:
    """U, (N, K), and L, (K,)."""
    at_s = np.frombuffer(time_s)
    shapes = _shapes(at_s, drift)
    if drift.colour:
        shapes = drift.colour.whitened(at_s, shapes)
    # Of the few shapes' products, a fifth of the time of a singular value decomposition of all samples.
    squares, mixed = np.linalg.eigh(shapes.T @ shapes)
    told = squares > _ROUNDING * squares[-1]  # of others nothing is left beside the noise
    return shapes @ (mixed[:, told] / np.sqrt(squares[told])), squares[told]


def _shapes(time_s: Array, drift: Drift) -> Array:
    """Shapes of drift times their size, (N, K)."""
    duration_s = float(time_s[-1] - time_s[0])
    share = (time_s - time_s[0]) / duration_s
    fastest_s = DRIFT_FASTEST_S / max(drift.size_sigma / DRIFT_SIZE_OF_FASTEST, 1.0)
    count = int(np.clip(2 * duration_s / fastest_s, 1, DRIFT_MOST_SHAPES))
    k = np.arange(1, count + 1)
    waves = (np.cos(np.pi * share[:, None] * k) - 1.0) / k
    shapes = [share, waves] if drift.zeroed else [np.full_like(share, _BEFORE), share, waves]
    return np.asarray(drift.size_sigma * np.column_stack(shapes))

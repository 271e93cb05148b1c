"""Slow drift of a sensor: a random walk, and the part of a residual that it may explain.

Within a trial of length T the drift is modelled as

    a + b (t / T) + sum over k of c_k cos(pi k t / T),    b, c_k k ~ N(0, D),  a ~ N(0, 3 D)

which is the spectrum of a random walk; D is its size, and a its value at the start.
With the drift's covariance G G' added to that of white noise, a residual r in units of sigma becomes
white by

    r - U (1 - 1 / sqrt(1 + L)) U' r,    G = U sqrt(L) V'

so that drift does not influence a fit; constants, and fast changes of the same size, hardly do;
residuals that are larger or faster than drift count as before.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import DRIFT_FASTEST_S, DRIFT_MOST_SHAPES

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_BEFORE = 3.0  # what a drift may have come to before a trial, in its size within one


def drift_whitening(time_s: Array, kept: Mask, size_sigma: float) -> Array:
    """W of the samples kept, (M, K): r - W W' r is white if r is white noise and drift.

    Args:
      size_sigma: D in units of the noise.
    """
    directions, lengths, _ = np.linalg.svd(_shapes(time_s, size_sigma)[kept], full_matrices=False)
    return np.asarray(directions * np.sqrt(1.0 - 1.0 / np.sqrt(1.0 + lengths**2)))


def likeliest_drift(time_s: Array, left: Array, size_sigma: float) -> Array:
    """The likeliest drift in a residual in sigma, at all its samples, (N,); NaN are left out."""
    kept, shapes = np.isfinite(left), _shapes(time_s, size_sigma)
    seen = shapes[kept]
    sizes = np.linalg.solve(seen.T @ seen + np.eye(seen.shape[1]), seen.T @ left[kept])
    return np.asarray(shapes @ sizes)


def _shapes(time_s: Array, size_sigma: float) -> Array:
    """Shapes of drift times their size, (N, K)."""
    duration_s = float(time_s[-1] - time_s[0])
    share = (time_s - time_s[0]) / duration_s
    count = int(np.clip(2 * duration_s / DRIFT_FASTEST_S, 1, DRIFT_MOST_SHAPES))
    k = np.arange(1, count + 1)
    waves = np.cos(np.pi * share[:, None] * k) / k
    before = np.full_like(share, _BEFORE)
    return np.asarray(size_sigma * np.column_stack([before, share, waves]))

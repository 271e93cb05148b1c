"""Slow drift of a sensor, projected out of what it reads.

Within a trial of length T a drift is any polynomial in time but a constant (that is a bias) of degree

    K = ceil(T / DRIFT_TIME_S)

and so wanders within some seconds at the fastest. A residual is taken beside the span of these: whatever
drift there is takes no part in a fit, at the price of K residuals per trial. What is taken off is the
drift by least squares.
"""

import numpy as np
from numpy.polynomial.legendre import legvander
from numpy.typing import NDArray

from diagnosis.criteria import DRIFT_MOST_DEGREES, DRIFT_TIME_S

Array = NDArray[np.float64]


def drift_degrees(time_s: Array) -> int:
    """K: how many shapes of drift a trial has."""
    duration_s = float(time_s[-1] - time_s[0])
    return int(np.clip(np.ceil(duration_s / DRIFT_TIME_S), 1, DRIFT_MOST_DEGREES))


def drift_basis(time_s: Array, kept: NDArray[np.bool_]) -> Array:
    """Orthonormal shapes of drift at the kept samples, (M, K)."""
    basis, _ = np.linalg.qr(_shapes(time_s, kept)[kept])
    return np.asarray(basis)


def fitted_drift(time_s: Array, left: Array) -> Array:
    """The drift in a residual, by least squares, at all its samples, (N,); NaN are left out."""
    kept = np.isfinite(left)
    shapes = _shapes(time_s, kept)
    size, *_ = np.linalg.lstsq(shapes[kept], left[kept], rcond=None)
    return np.asarray(shapes @ size)


def _shapes(time_s: Array, kept: NDArray[np.bool_]) -> Array:
    """Polynomials of degree 1 to K, free of a mean at the kept samples, (N, K)."""
    middle, half = 0.5 * (time_s[0] + time_s[-1]), 0.5 * (time_s[-1] - time_s[0])
    shapes = legvander((time_s - middle) / half, drift_degrees(time_s))[:, 1:]
    return np.asarray(shapes - shapes[kept].mean(axis=0))

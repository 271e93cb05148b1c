"""Curves through the neighbours of every sample, at uneven times, for many windows at once."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_ROBUST_STEPS = 12
_SMALL = 0.5  # residuals over the scale, below which they weigh alike


def interpolated(time_s: Array, values: Array, near: int, far: int) -> tuple[Array, Array]:
    """Cubics through two samples on each side (Lagrange), and the noise gain of sample minus cubic.

    Args:
      near, far: distances, in samples, of the neighbours on each side that the cubic goes through.

    Returns:
      (N,) each; NaN where a trial has no such neighbours.
    """
    n = values.size
    said, gain = np.full(n, np.nan), np.full(n, np.nan)
    middle = np.arange(far, n - far)
    at = [middle - far, middle - near, middle + near, middle + far]
    weights = []
    for i, own in enumerate(at):
        others = [other for j, other in enumerate(at) if j != i]
        top = np.prod([time_s[middle] - time_s[other] for other in others], axis=0)
        weights.append(top / np.prod([time_s[own] - time_s[other] for other in others], axis=0))
    said[middle] = sum(w * values[a] for w, a in zip(weights, at, strict=True))
    gain[middle] = np.sqrt(1 + sum(w**2 for w in weights))
    return said, gain


def robust_curve(powers: Array, y: Array, scale: Array) -> Array:
    """Curves of least absolute residuals, by iterative reweighting, (M, W).

    Args:
      powers: powers of the times in each of M windows of W samples, (M, W, P).
      y: readings, (M, W).
      scale: noise of the readings, by window, (M,).
    """
    weights = np.ones(y.shape)
    curve = np.zeros(y.shape)
    for _ in range(_ROBUST_STEPS):
        curve = least_squares(powers, y, weights, spread=False)[0]
        weights = 1 / np.maximum(np.abs(y - curve), _SMALL * scale[:, None]) * scale[:, None]
    return curve


def least_squares(
    powers: Array, y: Array, weights: Array | Mask, *, spread: bool = True
) -> tuple[Array, Array]:
    """Weighted fits: curves, (M, W), and their variances / variance of a reading, (M, W)."""
    weighted = powers * weights[:, :, None]
    normal = np.swapaxes(weighted, 1, 2) @ powers
    normal += 1e-9 * np.eye(powers.shape[2])  # where too few points are left, which is refused
    inverse = np.linalg.inv(normal)
    curve = (powers @ (inverse @ (np.swapaxes(weighted, 1, 2) @ y[:, :, None])))[:, :, 0]
    return curve, np.einsum("mwi,mij,mwj->mw", powers, inverse, powers) if spread else curve

"""The motion of the base through scattered readings, by polynomials through windows of many widths.

A polynomial through w readings tells the motion to h of the variance of one; h is least for a wide
window and in its middle. How far it is from the motion is told by what it leaves beyond that scatter:

    risk = h + max(0, sum of squares / variance - (w - order - 1)) / w,

in variances of a reading. Each reading takes the mean of all windows about it, with the weights risk^-4:
beside a corner those that end there count, in a smooth motion the wide ones about it.

Source: the choice of a window by its risk is that of A. Goldenshluger and A. Nemirovski, Mathematical
Methods of Statistics 6 (1997) 135; a mean in place of the best leaves a tenth less.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.polynomial.polynomial import polyvander
from numpy.typing import NDArray

Array = NDArray[np.float64]
Counts = NDArray[np.intp]

_WIDTHS = {1: (5, 7, 9, 13, 17, 25, 33), 2: (7, 11, 17), 3: (7, 9, 11, 13, 17, 25, 41), 5: (15, 25, 41)}
"""Widths of windows, samples, by the order of their polynomials."""
_RISK_POWER = 4
_EXACT_DEG = 1e-6
_MOST_OWN = 0.7  # weight of a reading in the curve, beyond which its neighbours are too few


@dataclass(frozen=True, kw_only=True, eq=False)
class MotionCurve:
    """A motion at N readings; NaN where too few are near.

    Attributes:
      angle_deg: (N,).
      rate_deg_s: (N,).
      own_share: weight of a reading in its angle, and the variance of that in the reading's, (N,).
    """

    angle_deg: Array
    rate_deg_s: Array
    own_share: Array


@dataclass(frozen=True, kw_only=True)
class Scatter:
    """Standard deviations of a reading, and of the time at which it was taken."""

    noise_deg: float
    jitter_s: float


def adaptive_curve(base_deg: Array, rows: Counts, step_s: float, scatter: Scatter) -> MotionCurve:
    """The motion at the readings.

    Args:
      base_deg: readings, (N,).
      rows: places of them on an even grid, (N,), from 0.
      step_s: of the grid.
    """
    readings = np.full(rows[-1] + 1, np.nan)
    readings[rows] = base_deg
    total, weights = np.zeros((3, rows.size)), np.zeros(rows.size)
    for order, widths in _WIDTHS.items():
        for width in (own for own in widths if own <= readings.size):
            for place, (told, risk) in enumerate(_windows(readings, order, width, step_s, scatter)):
                at = rows - place
                inside = np.flatnonzero((at >= 0) & (at < risk.size))
                weight = risk[at[inside]] ** -_RISK_POWER
                weights[inside] += weight
                total[:, inside] += weight * told[:, at[inside]]
    known = weights > 0
    angle, rate, share = np.where(known, total / np.where(known, weights, 1.0), np.nan)
    return MotionCurve(angle_deg=angle, rate_deg_s=rate, own_share=share)


def _windows(
    readings: Array, order: int, width: int, step_s: float, scatter: Scatter
) -> Iterator[tuple[Array, Array]]:
    """For each place in the M windows: angle, rate and own share there, (3, M), and the risk, (M,)."""
    inside = sliding_window_view(readings, width)
    there = np.isfinite(inside)
    any_one = np.where(there, inside, 0.0).sum(axis=1) / np.maximum(there.sum(axis=1), 1)
    values = np.where(there, inside - any_one[:, None], 0.0)  # squares of large angles keep no digits
    basis = polyvander(np.linspace(-1.0, 1.0, width), order)
    slopes = np.zeros_like(basis)
    slopes[:, 1:] = basis[:, :-1] * np.arange(1, order + 1) * 2 / ((width - 1) * step_s)
    free = there.sum(axis=1) - order - 1
    normal = np.einsum("mw,wi,wj->mij", there, basis, basis)
    normal[free < 1] = np.eye(order + 1)
    inverse = np.linalg.inv(normal)
    curve = np.einsum("mij,mj->mi", inverse, values @ basis)
    angle, rate = curve @ basis.T, curve @ slopes.T
    variance = scatter.noise_deg**2 + (rate * scatter.jitter_s) ** 2 + _EXACT_DEG**2
    squares = np.where(there, (values - angle) ** 2 / variance, 0.0)
    beyond = np.maximum(squares.sum(axis=1) - free, 0.0) / width
    share = np.einsum("wi,mij,wj->mw", basis, inverse, basis)
    usable = (free >= 1)[:, None] & (share < _MOST_OWN)
    risk = np.where(usable, share + beyond[:, None], np.inf)
    for place in range(width):
        yield np.stack([angle[:, place] + any_one, rate[:, place], share[:, place]]), risk[:, place]

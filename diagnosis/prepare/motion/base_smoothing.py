"""The motion of the base, estimated from its noisy readings.

The replay is driven by the measured base angle. Its noise would reappear as torque
noise; worse, it would release dry friction near the base, since hundredths
of a degree are not small compared with a presliding angle of 0.1 deg. So readings are
averaged over as long a window as the motion allows: polynomials are fitted in windows of
growing length, until a window's value leaves the confidence intervals of the shorter
ones (intersection of confidence intervals; Goldenshluger and Nemirovski, 1997).
Windows around, before and after a sample are weighted by the inverse of their remaining noise.
While the base rests, seconds are averaged; in a fast turn, hardly anything. What is left of the noise
makes no reversals of its own (diagnosis.prepare.motion.false_reversals).
"""

from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import Akima1DInterpolator
from scipy.signal import savgol_coeffs

from diagnosis.criteria.prepare import SMOOTHING_SIGMA
from diagnosis.prepare.motion.false_reversals import without_false_reversals

Array = NDArray[np.float64]

_WIDTHS = (5, 9, 17, 33, 65, 129, 257, 513)  # samples
# Order of the polynomial, and place of the sample in its window from 0 to 1.
_SIDES = ((2, 0.5), (1, 0.0), (1, 1.0), (0, 0.5), (0, 0.0), (0, 1.0))


def smooth_base(time_s: Array, reading_deg: Array, sigma_deg: float) -> Array:
    """Motion of the base, deg, (N,), from the readings of its encoder and their noise."""
    if sigma_deg <= 0:
        return reading_deg
    even = _even_times(time_s)
    raw = _on(even, time_s, reading_deg)
    chains = [_longest(raw, sigma_deg, *side) for side in _SIDES]
    weight = np.array([1 / spread**2 for _, spread in chains])
    value = np.array([value for value, _ in chains])
    smooth = (weight * value).sum(axis=0) / weight.sum(axis=0)
    return _on(time_s, even, without_false_reversals(smooth, sigma_deg))


def _even_times(time_s: Array) -> Array:
    """Even times within the trial that fall on as many of its samples as they can."""
    step_s = float(np.median(np.diff(time_s)))
    phase = np.angle(np.median(np.exp(2j * np.pi * (time_s - time_s[0]) / step_s))) / (2 * np.pi)
    return np.asarray(np.arange(time_s[0] + phase % 1.0 * step_s, time_s[-1] + 1e-6 * step_s, step_s))


def _on(at_s: Array, time_s: Array, values: Array) -> Array:
    """Values at other times; a straight line between samples would be off by a h^2 / 8 in fast turns."""
    return np.asarray(Akima1DInterpolator(time_s, values, extrapolate=True)(at_s))


def _longest(raw: Array, sigma: float, order: int, place: float) -> tuple[Array, Array]:
    """Value of the longest window that agrees with the shorter ones, and its spread.

    Args:
      order: order of the polynomial.
      place: place of the sample in its window, from 0 (first) to 1 (last).
    """
    best, spread = raw.copy(), np.full(raw.size, sigma)
    low, high = raw - SMOOTHING_SIGMA * sigma, raw + SMOOTHING_SIGMA * sigma
    open_ = np.ones(raw.size, bool)
    for width in _WIDTHS:
        if width > raw.size:
            break
        before = round(place * (width - 1))
        weights = _weights(width, order, before)
        value = np.full(raw.size, np.nan)  # where the window reaches beyond the trial
        value[before : raw.size - (width - 1 - before)] = np.correlate(raw, weights, "valid")
        own = sigma * float(np.linalg.norm(weights))
        low, high = (
            np.maximum(low, value - SMOOTHING_SIGMA * own),
            np.minimum(high, value + SMOOTHING_SIGMA * own),
        )
        open_ &= low <= high
        best, spread = np.where(open_, value, best), np.where(open_, own, spread)
    return best, spread


@cache
def _weights(width: int, order: int, before: int) -> Array:
    """Of the readings in a window, for the value of its polynomial after so many of them."""
    return np.asarray(savgol_coeffs(width, order, pos=before, use="dot"))

"""Reversals of the base that are only noise of its encoder, taken out of its estimated motion.

A dry element remembers every reversal, however small. Where the base rests, what smoothing leaves of
the noise takes a bearing back from its level by noise / presliding angle: its friction would come out
2 % too high beside an encoder with 0.02 deg of noise, 13 % beside one with 0.1 deg. So

- the motion turns only where it swings by more than the noise, and is monotone in between: of all
  monotone motions the nearest (isotonic regression; Barlow et al., 1972), which is no farther from the
  truth than what it replaces, if that is monotone too;
- about such a turning point the base rests as long as n values agree with their mean within what
  white noise would leave of it, two standard deviations sigma / sqrt(n).
"""

import math
from itertools import pairwise

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.optimize import isotonic_regression
from scipy.signal import find_peaks

from diagnosis.criteria.prepare import REVERSAL_SIGMA, STANDSTILL_SAMPLES, STANDSTILL_SIGMA

Array = NDArray[np.float64]
Index = NDArray[np.intp]


def without_false_reversals(motion: Array, sigma: float) -> Array:
    """A motion, (N,), that turns only where it does so by more than the noise sigma."""
    turns = turning_points(motion, REVERSAL_SIGMA * sigma)
    settled = motion.copy()
    for at in turns:
        first, last = _rest_about(motion, at, 2.0 * STANDSTILL_SIGMA * sigma)
        if last - first + 1 >= STANDSTILL_SAMPLES:
            settled[first : last + 1] = motion[first : last + 1].mean()
    for first, last in pairwise(turns):
        part = settled[first : last + 1]
        settled[first : last + 1] = isotonic_regression(part, increasing=bool(part[-1] > part[0])).x
    return settled


def turning_points(motion: Array, swing: float) -> Index:
    """First and last sample, and those in between where it turns by more than a swing, (K,)."""
    highest, _ = find_peaks(motion, prominence=swing)
    lowest, _ = find_peaks(-motion, prominence=swing)
    return np.unique([0, *highest, *lowest, motion.size - 1])


@njit(cache=True)
def _rest_about(motion: Array, at: int, range_of_one: float) -> tuple[int, int]:
    """First and last of the n samples, as many as can be, within a range of range_of_one / sqrt(n)."""
    first = last = at
    best = (at, at)
    low = high = motion[at]
    while first > 0 or last < motion.size - 1:
        before = abs(motion[first - 1] - motion[at]) if first > 0 else np.inf
        after = abs(motion[last + 1] - motion[at]) if last < motion.size - 1 else np.inf
        if before <= after:
            first -= 1
            value = motion[first]
        else:
            last += 1
            value = motion[last]
        low, high = min(low, value), max(high, value)
        if high - low > range_of_one:
            break
        if high - low <= range_of_one / math.sqrt(last - first + 1):
            best = (first, last)
    return best

"""How far the clocks of two columns are apart, by cross-correlation of their rates.

A twisted shaft answers at once: as the base starts, so does the torque. Rates of both are
correlated, in blocks of time; the lag of the highest product is the offset. How uncertain it is, is seen
from leaving out one block after the other (jackknife): with m blocks and lags l_i without block i, the
variance is (m - 1) / m sum (l_i - mean)^2.

The tip lags by itself, so that its offset is an upper limit and no clock.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from diagnosis.criteria import (
    ALIKE_PEAKS,
    CLOCK_BLOCKS,
    CLOCK_LONGEST_S,
    CLOCK_STEP_S,
    SIGN_LEAST_CORRELATION,
)
from diagnosis.lab_files.readers.lab_table import Array

_SMOOTHED_S = 0.1


@dataclass(frozen=True, kw_only=True)
class ClockOffset:
    """How much later a column shows what another one shows.

    Attributes:
      late_s: positive: it lags; None: they do not look alike.
      uncertainty_s: one standard deviation.
      reason: in words.
    """

    late_s: float | None
    uncertainty_s: float | None
    reason: str


def clock_offset(time_s: Array, values: Array, reference_time_s: Array, reference: Array) -> ClockOffset:
    """Lag of a column behind a reference, each with its own times, (N,) and (M,).

    Clocks without a common stretch are laid on top of each other at their first samples first.
    """
    shift = 0.0
    if time_s[0] > reference_time_s[-1] or time_s[-1] < reference_time_s[0]:
        shift = float(time_s[0] - reference_time_s[0])
    first = max(time_s[0] - shift, reference_time_s[0])
    last = min(time_s[-1] - shift, reference_time_s[-1])
    longest_s = min(CLOCK_LONGEST_S, (last - first) / 4)
    step_s = max(CLOCK_STEP_S, (last - first) / 100_000)
    even = np.arange(first, last, step_s)
    reach = int(longest_s / step_s)
    if even.size < 4 * CLOCK_BLOCKS or reach < 2:
        return ClockOffset(late_s=None, uncertainty_s=None, reason="too short to compare clocks")
    own = _rate(even, time_s - shift, values)
    other = _rate(even, reference_time_s, reference)
    blocks = np.array([_products(own, other, block, reach) for block in _blocks(even.size, reach)])
    whole = blocks.sum(axis=0)
    size = np.sqrt((own @ own) * (other @ other))
    match = float(np.abs(whole).max() / size) if size > 0 else 0.0
    if match < SIGN_LEAST_CORRELATION:
        return ClockOffset(
            late_s=None, uncertainty_s=None, reason=f"rates correlate by {match:.2f} only"
        )
    late = _peak(whole) * step_s
    without = np.array([_peak(whole - block) for block in blocks]) * step_s
    spread = float(np.sqrt((len(blocks) - 1) / len(blocks) * np.sum((without - without.mean()) ** 2)))
    uncertain = max(spread, step_s / np.sqrt(12))
    reason = f"rates correlate by {match:.2f}, {late + shift:+.3f} ± {uncertain:.2g} s apart"
    return ClockOffset(late_s=late + shift, uncertainty_s=uncertain, reason=reason)


def _rate(even: Array, time_s: Array, values: Array) -> Array:
    """Change per step, smoothed: where the highest product is does not depend on it."""
    good = np.isfinite(values)
    at = np.interp(even, time_s[good], values[good])
    width = max(_SMOOTHED_S, 2 * float(np.median(np.diff(time_s)))) / float(even[1] - even[0])
    rate = np.convolve(np.gradient(at), np.ones(round(width)) / width, mode="same")
    return np.asarray(rate - rate.mean())


def _blocks(size: int, reach: int) -> list[slice]:
    edges = np.linspace(reach, size - reach, CLOCK_BLOCKS + 1).astype(int)
    return [slice(a, b) for a, b in pairwise(edges.tolist())]


def _products(own: Array, other: Array, block: slice, reach: int) -> Array:
    """Sums of products over a block of the reference, for lags from -reach to reach."""
    window = own[block.start - reach : block.stop + reach]
    return np.correlate(window, other[block], mode="valid")


def _peak(products: Array) -> float:
    """Lag of the largest product, by a parabola through it and its neighbours.

    A motion that repeats has many products that are about as large: the one of the least lag is taken.
    """
    sizes, zero = np.abs(products), (products.size - 1) // 2
    inside = np.arange(1, sizes.size - 1)
    tops = inside[(sizes[1:-1] >= sizes[:-2]) & (sizes[1:-1] > sizes[2:])]
    tops = tops[sizes[tops] >= ALIKE_PEAKS * sizes.max()]
    if tops.size == 0:
        tops = np.array([np.argmax(sizes)])
    top = int(tops[np.argmin(np.abs(tops - zero))])
    centre = float(top - zero)
    if 0 < top < sizes.size - 1:
        left, middle, right = sizes[top - 1 : top + 2]
        bend = left - 2 * middle + right
        centre += 0.5 * (left - right) / bend if bend < 0 else 0.0
    return float(centre)

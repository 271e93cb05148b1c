"""The offset between the clocks of a sensor and of the base, by cross-correlation.

The model is a shaft that relaxes within a time tau: the tip is a low-pass filtered base angle, and the
torque is proportional to the difference. Of several tau the one whose rates match best is used; the lag
with the largest product is the offset. This removes most of the needle's own lag. The uncertainty is
from leaving out one block of time after the other (jackknife): with m blocks and lags l_i without block
i, the variance is (m - 1) / m sum (l_i - mean)^2.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.signal import lfilter

from diagnosis.criteria.lab_files import (
    ALIKE_PEAKS,
    CLOCK_BLOCKS,
    CLOCK_LEAST_CORRELATION,
    CLOCK_LONGEST_S,
    CLOCK_STEP_S,
)
from diagnosis.lab_files.readers.lab_table import Array

_SMOOTHED_S = 0.1
_RELAXES_S = (0.03, 0.1, 0.3, 1.0, 3.0, 10.0)


@dataclass(frozen=True, kw_only=True)
class ClockOffset:
    """The time by which one column is later than another one.

    Attributes:
      late_s: positive: it lags; None: the columns are not similar.
      uncertainty_s: standard deviation.
      reason: in words.
    """

    late_s: float | None
    uncertainty_s: float | None
    reason: str


def clock_offset(
    time_s: Array, values: Array, base_time_s: Array, base: Array, *, torque: bool
) -> ClockOffset:
    """Lag of a torque, or of the tip, behind the base's angle; each with its own times, (N,) and (M,).

    If the clocks have no common interval, their first samples are aligned before.
    """
    shift = 0.0
    if time_s[0] > base_time_s[-1] or time_s[-1] < base_time_s[0]:
        shift = float(time_s[0] - base_time_s[0])
    first = max(time_s[0] - shift, base_time_s[0])
    last = min(time_s[-1] - shift, base_time_s[-1])
    longest_s = min(CLOCK_LONGEST_S, (last - first) / 4)
    step_s = max(CLOCK_STEP_S, (last - first) / 100_000)
    even = np.arange(first, last, step_s)
    reach = int(longest_s / step_s)
    if even.size < 4 * CLOCK_BLOCKS or reach < 2:
        return ClockOffset(late_s=None, uncertainty_s=None, reason="too short to compare clocks")
    own = _rate(even, time_s - shift, values)
    turned = np.interp(even, base_time_s[np.isfinite(base)], base[np.isfinite(base)])
    match, blocks = 0.0, np.zeros((CLOCK_BLOCKS, 2 * reach + 1))
    for relaxes_s in _RELAXES_S:
        kept = _low_pass(turned, step_s / relaxes_s)
        other = _rate(even, even, turned - kept if torque else kept)
        found = np.array([_products(own, other, block, reach) for block in _blocks(even.size)])
        size = float(np.sqrt((own @ own) * (other @ other)))
        alike = float(np.abs(found.sum(axis=0)).max()) / size if size > 0 else 0.0
        if alike > match:
            match, blocks = alike, found
    whole = blocks.sum(axis=0)
    if match < CLOCK_LEAST_CORRELATION:
        return ClockOffset(
            late_s=None, uncertainty_s=None, reason=f"rates correlate by {match:.2f} only"
        )
    top = _highest(whole)
    if top is None:
        reason = f"no lag below {longest_s:.2g} s stands out"
        return ClockOffset(late_s=None, uncertainty_s=None, reason=reason)
    lobe = _lobe(whole, top)
    late = _peak(whole, lobe) * step_s
    without = np.array([_peak(whole - block, lobe) for block in blocks]) * step_s
    spread = float(np.sqrt((len(blocks) - 1) / len(blocks) * np.sum((without - without.mean()) ** 2)))
    uncertain = max(spread, step_s / float(np.sqrt(12)))
    reason = f"rates correlate by {match:.2f}, {late + shift:+.3f} ± {uncertain:.2g} s apart"
    return ClockOffset(late_s=late + shift, uncertainty_s=uncertain, reason=reason)


def _rate(even: Array, time_s: Array, values: Array) -> Array:
    """Change per step, smoothed: where the highest product is does not depend on it."""
    good = np.isfinite(values)
    at = np.interp(even, time_s[good], values[good])
    width = max(_SMOOTHED_S, 2 * float(np.median(np.diff(time_s)))) / float(even[1] - even[0])
    rate = np.convolve(np.gradient(at), np.ones(round(width)) / width, mode="same")
    return np.asarray(rate - rate.mean())


def _low_pass(values: Array, share: float) -> Array:
    """First-order low-pass filter that removes this share of the difference in each step."""
    gain = 1 - np.exp(-share)
    return np.asarray(values[0] + lfilter([gain], [1, gain - 1], values - values[0]))


def _blocks(size: int) -> list[slice]:
    edges = np.linspace(0, size, CLOCK_BLOCKS + 1).astype(int)
    return [slice(a, b) for a, b in pairwise(edges.tolist())]


def _products(own: Array, other: Array, block: slice, reach: int) -> Array:
    """Sums of products over a block of the reference, for lags from -reach to reach."""
    window = np.pad(own, reach)[block.start : block.stop + 2 * reach]
    return np.asarray(np.correlate(window, other[block], mode="valid"))


def _highest(products: Array) -> int | None:
    """Index of the largest product; None if it is at an end of the lags.

    A periodic motion has many products of about this size: the one with the smallest lag is used.
    """
    sizes, zero = np.abs(products), (products.size - 1) // 2
    inside = np.arange(1, sizes.size - 1)
    tops = inside[(sizes[1:-1] >= sizes[:-2]) & (sizes[1:-1] > sizes[2:])]
    tops = tops[sizes[tops] >= ALIKE_PEAKS * sizes.max()]
    return int(tops[np.argmin(np.abs(tops - zero))]) if tops.size else None


def _lobe(products: Array, top: int) -> slice:
    """Lags around the highest product, to where it has fallen by half."""
    low = np.flatnonzero(np.abs(products) < np.abs(products[top]) / 2)
    first = int(max(low[low < top], default=0))
    last = int(min(low[low > top], default=products.size - 1))
    return slice(first, last + 1)


def _peak(products: Array, lobe: slice) -> float:
    """Lag of the largest product within a lobe, by a parabola through it and its neighbours."""
    sizes = np.abs(products)
    top = lobe.start + int(np.argmax(sizes[lobe]))
    centre = float(top - (products.size - 1) // 2)
    if 0 < top < sizes.size - 1:
        left, middle, right = sizes[top - 1 : top + 2]
        bend = left - 2 * middle + right
        centre += 0.5 * float(left - right) / float(bend) if bend < 0 else 0.0
    return centre

"""Outliers: one or a few successive samples that disagree with the samples on both sides.

Readings may move fast and with corners, so a sample is compared with a cubic through its
neighbours, which is fitted robustly (least absolute residuals) and then by least squares without the
samples far from it. A sample is an outlier if all of these conditions hold:

- it is off by more than z sigma sqrt(1 + leverage), with z for a small chance with white noise, and
  sigma at least the scatter of the readings near it (in a fast motion, jitter of time acts as noise);
- the neighbours on both sides agree with one curve: their residual is small compared with the sample's;
- neither side alone, by a parabola or line, predicts it: at a corner of the motion, one side does.

Outliers that were found are removed, and the search is repeated.

The first two and the last two samples have too little on one side. They are left out if neither a line
nor a parabola through the samples beside them comes near: should the motion have begun or ended there,
two samples less tell nothing less. This comes last, when those samples have no outliers among them, and
is not repeated: it would eat into a motion that is fast there.

Source: robust local regression, Cleveland, J. Am. Stat. Assoc. 74 (1979) 829; Hampel's identifier.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.special import betaincinv, ndtri

from diagnosis.criteria.faults import (
    OUTLIER_CLEARANCE,
    OUTLIER_FALSE_ALARMS,
    OUTLIER_MISFIT,
    OUTLIER_MOST_BESIDE,
    OUTLIER_MOST_RUN,
    OUTLIER_ONE_SIDED,
)
from diagnosis.log.local_curves import interpolated, least_squares, robust_curve

Array = NDArray[np.float64]
Index = NDArray[np.intp]
Mask = NDArray[np.bool_]
Look = Callable[[Array, Array, Array], tuple[Index, Array]]

AT_AN_END = 2  # samples that have too little on one side
_HALVES = (4, 7)  # neighbours on each side
_SIDE_ORDER = {4: 1, 7: 2}  # of the curve through one side of so many
_ORDER = 3  # of the curve
_PASSES = 4
_STENCILS = ((1, 2), (2, 4), (3, 6))  # neighbours on each side of a cubic
_APART = ((1, 3), (2, 5), (4, 6))  # without one in common: an outlier beside a sample is in one alone
_LEFT_OUT_SIGMA = 3.5  # what least squares leaves out of a window
_SCREENED_SIGMA = 3.0  # what is fitted at all: it leaves out none of the outliers that fits would find
_ABOUT = 32  # samples on each side whose scatter counts
_QUIET_SHARE = 0.4  # of these, that outliers beside them do not reach
# That quantile of the middle one of three residuals, of white noise: their shares are as Beta(2, 2).
_QUIET_SIZE = float(ndtri(0.5 + 0.5 * betaincinv(2, 2, _QUIET_SHARE)))
_LOUD = 1.5  # times sigma: what a local scatter comes to by chance
_MARGIN = 1.25  # of a local scatter: half of the samples about it tell it to a fifth
_CHUNK = 20_000  # windows that are fitted at once


@dataclass(frozen=True, kw_only=True)
class Outliers:
    """Outliers of a column.

    Attributes:
      rows: mask of the outliers, (N,).
      expected: values from their neighbours; the readings elsewhere, (N,).
    """

    rows: Mask
    expected: Array

    def without(self, some: Mask, values: Array) -> "Outliers":
        """The outliers without some rows, whose readings are valid."""
        return Outliers(rows=self.rows & ~some, expected=np.where(some, values, self.expected))


def find_outliers(time_s: Array, values: Array, sigma: float) -> Outliers:
    """Outliers among readings, (N,) each; values that are not finite are none.

    Args:
      sigma: white noise of the readings, in their unit.
    """
    rows, expected = np.zeros(values.size, bool), values.copy()
    for _ in range(_PASSES):
        if not _taken_out(time_s, values, sigma, _within, rows, expected):
            break
    _taken_out(time_s, values, sigma, _at_ends, rows, expected)
    rows &= ~_in_long_run(rows)
    return Outliers(rows=rows, expected=np.where(rows, expected, values))


def _taken_out(
    time_s: Array, values: Array, sigma: float, look: Look, rows: Mask, expected: Array
) -> bool:
    """Whether there are outliers among the remaining samples; they are added to the rows, in place."""
    rest = np.flatnonzero(np.isfinite(values) & ~rows)
    if not sigma > 0 or rest.size < 2 * _ABOUT:
        return False
    scale = _scatter_about(time_s[rest], values[rest], sigma)
    found, said = look(time_s[rest], values[rest], scale)
    rows[rest[found]], expected[rest[found]] = True, said
    return bool(found.size)


def _in_long_run(rows: Mask) -> Mask:
    """Mask of outliers in long runs: these are events."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], rows.astype(np.int8), [0])))).reshape(-1, 2)
    long = np.zeros(rows.size, bool)
    for start, end in edges[edges[:, 1] - edges[:, 0] > OUTLIER_MOST_RUN]:
        long[start:end] = True
    return long


def _limit(count: int) -> float:
    """By how many standard deviations an outlier is off, among so many readings."""
    return float(-ndtri(OUTLIER_FALSE_ALARMS / (2 * len(_HALVES) * count)))


def _within(time_s: Array, values: Array, scale: Array) -> tuple[Index, Array]:
    """Outliers with samples on both sides, and the values expected there.

    Args:
      scale: scatter of the readings near each sample, (N,).
    """
    suspects = _screened(time_s, values, scale)
    rows, expected = np.zeros(values.size, bool), np.zeros(values.size)
    for half in _HALVES:
        for part in np.array_split(suspects, suspects.size // _CHUNK + 1):
            off, said = _judged(time_s, values, scale, part, half, _limit(values.size))
            rows[part[off]], expected[part[off]] = True, said[off]
    return np.flatnonzero(rows), expected[rows]


def _at_ends(time_s: Array, values: Array, scale: Array) -> tuple[Index, Array]:
    """The same of the first two samples, and of the last two."""
    rows, expected = np.zeros(values.size, bool), np.zeros(values.size)
    for end in (slice(None), slice(None, None, -1)):
        _add_end(time_s[end], values[end], scale[end], _limit(values.size), rows[end], expected[end])
    return np.flatnonzero(rows), expected[rows]


def _add_end(
    time_s: Array, values: Array, scale: Array, limit: float, rows: Mask, expected: Array
) -> None:
    """Add to rows and expected values, in place, what is off at the beginning of a column."""
    first = slice(0, AT_AN_END)
    away, said = np.full(AT_AN_END, np.inf), np.zeros(AT_AN_END)
    for count, order in _SIDE_ORDER.items():
        beside = slice(AT_AN_END, AT_AN_END + count)
        x = (time_s[: beside.stop] - time_s[beside.start]) / (
            time_s[beside.stop - 1] - time_s[beside.start]
        )
        powers = np.vander(x, order + 1)
        inverse = np.linalg.pinv(powers[beside])
        curve = powers[first] @ inverse @ values[beside]
        gain = np.sqrt(1.0 + np.sum((powers[first] @ inverse) ** 2, axis=1))
        off = np.abs(values[first] - curve) / (gain * scale[first])
        said, away = np.where(off < away, curve, said), np.minimum(off, away)
    rows[first] |= away > limit
    expected[first] = np.where(away > limit, said, expected[first])


def _scatter_about(time_s: Array, values: Array, sigma: float) -> Array:
    """Scatter of the readings near each sample, if it is significantly above sigma; else sigma, (N,)."""
    each = [interpolated(time_s, values, near, far) for near, far in _APART]
    size = np.median([np.abs(values - said) / gain for said, gain in each], axis=0)
    end = max(max(stencil) for stencil in _APART)
    padded = np.pad(size[end:-end], end + _ABOUT, mode="reflect")
    windows = sliding_window_view(padded, 2 * _ABOUT + 1)
    rank = round(2 * _ABOUT * _QUIET_SHARE)
    local = np.partition(windows, rank, axis=1)[:, rank] / _QUIET_SIZE
    return np.where(local > _LOUD * sigma, _MARGIN * local, sigma)


def _screened(time_s: Array, values: Array, scale: Array) -> Index:
    """Indices of samples to examine: all near the ends, and those that are off a cubic."""
    off = np.zeros(values.size)
    for near, far in _STENCILS:
        said, gain = interpolated(time_s, values, near, far)
        off = np.fmax(off, np.abs(values - said) / (gain * scale))
    ends = max(_HALVES)
    off[:ends], off[-ends:] = np.inf, np.inf
    return np.flatnonzero(off > _SCREENED_SIGMA)


def _judged(
    time_s: Array, values: Array, scale: Array, rows: Index, half: int, limit: float
) -> tuple[Mask, Array]:
    """Which of the rows are outliers among `half` neighbours on each side, and their expected values."""
    width = 2 * half + 1
    first = np.clip(rows - half, 0, values.size - width)
    window = first[:, None] + np.arange(width)
    x = time_s[window] - time_s[rows][:, None]
    x /= np.abs(x).max(axis=1, keepdims=True)
    y, own = values[window] - values[rows][:, None], scale[rows]
    powers = x[:, :, None] ** np.arange(_ORDER + 1)
    itself = window == rows[:, None]
    left = y - robust_curve(powers, y, own)
    good = (np.abs(left) <= _LEFT_OUT_SIGMA * own[:, None]) & ~itself
    curve, spread = least_squares(powers, y, good)
    left = np.where(good, y - curve, 0.0)
    here = np.argmax(itself, axis=1)[:, None]
    off = -np.take_along_axis(curve, here, axis=1)[:, 0]
    noise = np.sqrt(1 + np.take_along_axis(spread, here, axis=1)[:, 0])
    freedom = np.maximum(good.sum(axis=1) - _ORDER - 1, 1)
    chance = OUTLIER_MISFIT * own**2
    misfit = np.sqrt(np.maximum((left**2).sum(axis=1) / freedom - chance, 0.0))
    outlying = np.abs(off) > np.maximum(limit * own * noise, OUTLIER_CLEARANCE * misfit)
    outside = width - good.sum(axis=1)
    outlying &= outside <= OUTLIER_MOST_BESIDE
    for side in (x < 0, x > 0):
        far = _far_from_side(powers[:, :, : _SIDE_ORDER[half] + 1], y, good & side, here, off, own)
        at_end = (side.sum(axis=1) < half) & (outside <= 2)
        outlying &= far | at_end
    # A step of the readings looks the same where it has hardly a sample before or after it.
    outlying &= (rows >= AT_AN_END) & (rows < values.size - AT_AN_END)
    return outlying, values[rows] - off


def _far_from_side(powers: Array, y: Array, good: Mask, here: Index, off: Array, scale: Array) -> Mask:
    """Whether a curve through the good points of one side is off the sample, on the same side of it."""
    curve, variance = least_squares(powers, y, good)
    apart = -np.sign(off) * np.take_along_axis(curve, here, axis=1)[:, 0]
    noise = scale * np.sqrt(1 + np.take_along_axis(variance, here, axis=1)[:, 0])
    enough = good.sum(axis=1) > powers.shape[2]
    return np.asarray(enough & (apart - noise > OUTLIER_ONE_SIDED * np.abs(off)))

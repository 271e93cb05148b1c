"""Which of two residuals leads the other, and by how long.

Their cross-correlation over lags of up to two seconds has a peak if one is a late copy of the other.
Three conditions make the peak a lead: it is higher than chance allows for residuals with these
autocorrelations (Bartlett: the variance is sum_k rho_1(k) rho_2(k) / N); the 95 % interval of its lag,
from resampled blocks of two seconds, excludes zero; and it is not at the longest lag.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import correlate

from diagnosis.criteria.residuals import LEAD_SIGMA, LONGEST_LEAD_S

Array = NDArray[np.float64]

_BLOCK_S = 2.0
_BOOTSTRAPS = 400
_LEAST_BLOCKS = 4


@dataclass(frozen=True, kw_only=True)
class Lead:
    """Which residual leads.

    Attributes:
      signal: the signal that leads; empty: uncertain.
      by_s: time by which it leads; if uncertain, that by which the first leads the second.
      low_s, high_s: its 95 % interval.
      correlation: correlation at the peak; negative if the signs are opposite.
      chance_limit: size of the correlation that chance alone does not reach.
    """

    signal: str
    by_s: float
    low_s: float
    high_s: float
    correlation: float
    chance_limit: float


def lead(signals: tuple[str, str], parts: Sequence[tuple[Array, Array]], step_s: float) -> Lead | None:
    """Which of two residuals leads.

    Args:
      signals: names of the first and of the second.
      parts: both at even steps, for each trial that has both; NaN where nothing was read.

    Returns:
      None if there are fewer than four blocks of both.
    """
    most = round(LONGEST_LEAD_S / step_s)
    blocks = _blocks(parts, max(1, round(_BLOCK_S / step_s)), most)
    if len(blocks) < _LEAST_BLOCKS:
        return None
    products, pairs = (np.asarray(own) for own in zip(*blocks, strict=True))
    curve = products.sum(axis=0) / np.maximum(pairs.sum(axis=0), 1) / _scale(parts)
    sign = 1.0 if curve[np.argmax(np.abs(curve))] > 0 else -1.0
    at = _peak(sign * curve)
    low, high = np.quantile(_resampled_peaks(sign * products, pairs), [0.025, 0.975])
    # A lag leaves out ends of the trials: where these are quiet, the ratio comes to a little above 1.
    height, limit = min(float(np.abs(curve).max()), 1.0), LEAD_SIGMA * _chance(parts, most)
    certain = height > limit and low * high > 0 and abs(at - most) < most
    first = at > most
    by, ends = (at - most, (low, high)) if first or not certain else (most - at, (-high, -low))
    return Lead(
        signal=signals[0 if first else 1] if certain else "",
        by_s=float(by * step_s),
        low_s=float(ends[0] * step_s),
        high_s=float(ends[1] * step_s),
        correlation=float(sign * height),
        chance_limit=float(limit),
    )


def _blocks(parts: Sequence[tuple[Array, Array]], size: int, most: int) -> list[tuple[Array, Array]]:
    """For each block of the first: sums of products with the second at lags -most..most, and pairs."""
    found = []
    for first, second in parts:
        (x, x_read), (y, y_read) = _centred(first), _centred(second)
        y, y_read = np.pad(y, most), np.pad(y_read, most)
        for begin in range(0, x.size - size + 1, size):
            own, around = slice(begin, begin + size), slice(begin, begin + size + 2 * most)
            products = correlate(y[around], x[own], mode="valid")
            found.append((products, correlate(y_read[around], x_read[own], mode="valid")))
    return found


def _centred(values: Array) -> tuple[Array, Array]:
    """A residual minus its mean, 0 where nothing was read; and a mask of the readings."""
    read = np.isfinite(values)
    mean = values[read].mean() if read.any() else 0.0
    return np.where(read, values - mean, 0.0), read.astype(float)


def _scale(parts: Sequence[tuple[Array, Array]]) -> float:
    """Product of both standard deviations."""
    sizes = []
    for own in zip(*parts, strict=True):
        each = [_centred(values) for values in own]
        squares, samples = sum(float(v @ v) for v, _ in each), sum(float(r.sum()) for _, r in each)
        sizes.append(squares / max(samples, 1.0))
    return float(np.sqrt(sizes[0] * sizes[1])) or 1.0


def _peak(curve: Array) -> float:
    """Place of the largest value, between its neighbours by a parabola."""
    k = int(np.argmax(curve))
    if k in (0, curve.size - 1):
        return float(k)
    left, top, right = curve[k - 1 : k + 2]
    bend = left - 2 * top + right
    return k + float(0.5 * (left - right) / bend) if bend < 0 else float(k)


def _resampled_peaks(products: Array, pairs: Array) -> Array:
    """Lags of the peak in steps, of resampled blocks."""
    count, most = products.shape[0], products.shape[1] // 2
    rng = np.random.default_rng(0)
    weights = rng.multinomial(count, np.full(count, 1 / count), size=_BOOTSTRAPS)
    curves = (weights @ products) / np.maximum(weights @ pairs, 1)
    return np.asarray([_peak(curve) - most for curve in curves])


def _chance(parts: Sequence[tuple[Array, Array]], most: int) -> float:
    """Standard deviation of the correlation of two independent residuals with these autocorrelations."""
    memories = [_memory(own, most) for own in zip(*parts, strict=True)]
    samples = min(
        sum(int(np.isfinite(values).sum()) for values in own) for own in zip(*parts, strict=True)
    )
    total = 1 + 2 * float(memories[0] @ memories[1])
    return float(np.sqrt(max(total, 1.0) / max(samples, 1)))


def _memory(parts: Sequence[Array], most: int) -> Array:
    """Autocorrelation at lags 1..most."""
    each = [_centred(values)[0] for values in parts]
    products = np.sum([correlate(np.pad(v, (0, most)), v, mode="valid") for v in each], axis=0)
    return np.asarray(products[1:] / (products[0] or 1.0))

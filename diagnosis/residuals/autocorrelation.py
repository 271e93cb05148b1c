"""Autocorrelation of a residual.

With values r at even steps, over the pairs that were both read,

    rho(k) = mean(r[i] r[i + k]) / mean(r[i]^2),    T = step (1 + 2 sum_k rho(k)).

White noise has |rho| < 1.96 / sqrt(N), of N pairs, at 95 of 100 lags and T of one step; duration / T
is the number of independent samples. The mean is not subtracted: a residual should have none.
The sum ends at the first lag beyond five T (Sokal 1996), since later lags only add noise; if the
correlation is too long for the length of the trials, there is no T.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import correlate

from diagnosis.criteria.assessment import INTERVAL_Z
from diagnosis.criteria.residuals import LONGEST_LAG_S

Array = NDArray[np.float64]

_WINDOWS = 5.0  # integral times after which the sum ends
_SHARE = 4  # of the longest trial that the longest lag is at most, one in so many
_SHOWN = 40  # lags, evenly in their logarithm


@dataclass(frozen=True, kw_only=True)
class Autocorrelation:
    """The autocorrelation of a residual.

    Attributes:
      lag_one_correlation: rho from one sample to the next.
      integral_s: T; None: too long for these trials.
      white_limit: limit of |rho| for white noise at 95 of 100 lags; for the lag with the fewest pairs.
      by_lag_s: some lags, and rho at these.
    """

    lag_one_correlation: float
    integral_s: float | None
    white_limit: float
    by_lag_s: list[tuple[float, float]]


def autocorrelation(parts: Sequence[Array], step_s: float) -> Autocorrelation | None:
    """Autocorrelation of a residual at even steps, one array per trial; NaN where nothing was read.

    Returns:
      None if the trials have fewer than eight samples, or no residual.
    """
    most = min(round(LONGEST_LAG_S / step_s), max(part.size for part in parts) // _SHARE)
    products, pairs = _products(parts, most)
    if most <= 1 or products[0] <= 0:
        return None
    rho = products / np.maximum(pairs, 1) / (products[0] / pairs[0])
    shown = np.unique(np.rint(np.geomspace(1, most, _SHOWN)).astype(int))
    return Autocorrelation(
        lag_one_correlation=float(rho[1]),
        integral_s=_integral_s(rho, step_s),
        white_limit=float(INTERVAL_Z / np.sqrt(max(pairs.min(), 1.0))),
        by_lag_s=[(float(k * step_s), float(rho[k])) for k in shown],
    )


def _products(parts: Sequence[Array], most: int) -> tuple[Array, Array]:
    """Sums of r[i] r[i + k], and their numbers of pairs, for lags k from 0 to `most`."""
    products, pairs = np.zeros(most + 1), np.zeros(most + 1)
    for part in parts:
        read = np.isfinite(part)
        products += _at_lags(np.where(read, part, 0.0), most)
        pairs += np.rint(_at_lags(read.astype(float), most))
    return products, pairs


def _at_lags(values: Array, most: int) -> Array:
    later = np.concatenate([values, np.zeros(most)])
    return np.asarray(correlate(later, values, mode="valid"))


def _integral_s(rho: Array, step_s: float) -> float | None:
    steps = 1 + 2 * np.cumsum(rho[1:])
    ended = np.flatnonzero(np.arange(1, rho.size) >= _WINDOWS * steps)
    return float(max(steps[ended[0]], 1.0) * step_s) if ended.size else None

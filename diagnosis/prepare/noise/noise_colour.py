"""Noise that is correlated in time: white noise beside a first-order process.

The noise of a filtered or slowly wandering sensor is correlated. A share w of its variance is
white, and a share c = 1 - w is an Ornstein-Uhlenbeck process of correlation time tau, with the
autocovariance

    c exp(-|t| / tau)

At even steps it is an AR(1) process, and the sum of both an ARMA(1, 1). Means of n readings, each at
steps h, of an Ornstein-Uhlenbeck process of variance 1 have the autocovariances

    at lag 0      (n + 2 sum over k of (n - k) p^k) / n^2,   p = exp(-h / tau)
    at others     g exp(-|t| / tau),   g = ((1 - p^n) / (1 - p))^2 p^(1 - n) / n^2

g exceeds the variance, so that c may exceed 1 and w is then negative. Whitened noise is the
noise minus its prediction from the past, / standard deviation of the rest: the innovations of the
Kalman filter whose state is the coloured part,

    e = y - a,   S = P + w,   K = P / S
    a <- phi (a + K e),   P <- phi^2 P w / S + c (1 - phi^2),   phi = exp(-step / tau)

This is exact for samples at any times, also with missing ones (if w is negative, unless some
are much closer than the step of the means). It is linear in y: differences of
residuals and slopes are whitened like residuals, and the sum of squares of whitened residuals is
-2 log(likelihood), up to a constant.
"""

from dataclasses import dataclass

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]

_LEAST_VARIANCE = 1e-3  # of a sample that those before it predict, where times are too close for means


@dataclass(frozen=True, kw_only=True)
class NoiseColour:
    """Correlation in time of one sensor's noise, whatever its size.

    Attributes:
      share: share of the variance that is coloured, above 0; above 1 for means of coloured readings.
      correlation_time_s: time in which the autocovariance of the coloured part falls to 37 %.
    """

    share: float
    correlation_time_s: float

    def whitened(self, time_s: Array, values: Array) -> Array:
        """Innovations / their standard deviation; noise of variance 1 becomes white noise of variance 1.

        Args:
          time_s: (N,), increasing.
          values: residuals / sigma, (N,) or (N, n).
        """
        columns = np.ascontiguousarray(values.reshape(time_s.size, -1), float)
        told, _ = _innovations(self._kept(time_s), columns, self.share)
        return np.asarray(told).reshape(values.shape)

    def uncertainty(self, time_s: Array) -> float:
        """Sum of the logarithms of the variances of samples, given those before them."""
        _, log_variance = _innovations(self._kept(time_s), np.zeros((time_s.size, 0)), self.share)
        return float(log_variance)

    def restored(self, time_s: Array, whitened: Array) -> Array:
        """The inverse of `whitened`."""
        columns = np.ascontiguousarray(whitened.reshape(time_s.size, -1), float)
        return np.asarray(_readings(self._kept(time_s), columns, self.share)).reshape(whitened.shape)

    def density(self, step_s: float) -> float:
        """Spectral density at frequency 0 of samples at even steps / that of white noise."""
        times = step_s / (2 * self.correlation_time_s)
        return float(1 - self.share + self.share / np.tanh(times))

    def covariances(self, lags_s: Array) -> Array:
        """Autocovariances of the coloured part alone / its variance, (N,)."""
        return np.asarray(np.exp(-np.abs(lags_s) / self.correlation_time_s))

    def _kept(self, time_s: Array) -> Array:
        """Factor phi of the coloured part from the sample before to each, (N,); 0 for the first."""
        return np.exp(-np.diff(time_s, prepend=-np.inf) / self.correlation_time_s)


def covariances_of_means(lags_s: Array, time_s: float, step_s: float, count: int) -> tuple[Array, float]:
    """Autocovariances of means of readings of an Ornstein-Uhlenbeck process of variance 1, (L,), and g.

    Args:
      lags_s: 0 and multiples of the means' step, s, (L,).
      time_s: correlation time, s.
      step_s: step of the means, s.
      count: readings in each mean.
    """
    own, at_once = np.arange(count), -step_s / count / time_s
    variance = float(np.exp(at_once * np.abs(own[:, None] - own)).mean())
    later = float(np.exp(at_once * (own - own[:, None])).mean())
    return np.where(lags_s == 0, variance, later * np.exp(-lags_s / time_s)), later


@njit(cache=True)
def _innovations(kept: Array, values: Array, share: float) -> tuple[Array, float]:
    told = np.empty_like(values)
    state = np.zeros(values.shape[1])
    spread, log_variance = share, 0.0
    for i in range(kept.size):
        state *= kept[i]
        spread = kept[i] ** 2 * spread + share * (1 - kept[i] ** 2)
        variance = max(spread + 1 - share, _LEAST_VARIANCE)
        log_variance += np.log(variance)
        for j in range(values.shape[1]):
            missed = values[i, j] - state[j]
            told[i, j] = missed / np.sqrt(variance)
            state[j] += spread / variance * missed
        spread *= (1 - share) / variance
    return told, log_variance


@njit(cache=True)
def _readings(kept: Array, told: Array, share: float) -> Array:
    values = np.empty_like(told)
    state = np.zeros(told.shape[1])
    spread = share
    for i in range(kept.size):
        state *= kept[i]
        spread = kept[i] ** 2 * spread + share * (1 - kept[i] ** 2)
        variance = max(spread + 1 - share, _LEAST_VARIANCE)
        for j in range(told.shape[1]):
            missed = told[i, j] * np.sqrt(variance)
            values[i, j] = state[j] + missed
            state[j] += spread / variance * missed
        spread *= (1 - share) / variance
    return values

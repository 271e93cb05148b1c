"""Noise of readings at even steps that a digital filter has shaped: an autoregression.

Every value is a sum over the p before it, and a white rest:

    y[i] = a_1 y[i - 1] + ... + a_p y[i - p] + s w[i],    w ~ N(0, 1),    variance of y = 1

Whitened noise is w: what those before do not tell, / its standard deviation. Where samples are missing
this is the Kalman filter whose state are the last p values: those that were read are known, and those
that were not have the variance that all before them leave,

    m <- F m,    P <- F P F' + s^2 e e',    and with a reading y:  m <- m + K (y - m_1),  P <- P - K P_1

where F moves each value one place on and puts the predicted one first, and e is that first place. Time
stamps tell no more than how many steps there are between two samples, so that they may scatter.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray
from scipy.linalg import solve_toeplitz

from diagnosis.prepare.noise.colour import Colour

Array = NDArray[np.float64]

_MOST_OF_MEANS = 6  # values before that tell the means of many
_TELL_A_STEP = 16  # samples, to begin with
_FORGOTTEN_STEPS = 2000  # a gap after which nothing is known; longer ones are as long


@dataclass(frozen=True, kw_only=True)
class Autoregression(Colour):
    """Correlation of one sensor's noise from sample to sample, whatever its size.

    Attributes:
      autocovariances: at lags of 0 to p steps, / that at 0.
      step_s: of the samples.
    """

    autocovariances: tuple[float, ...]
    step_s: float

    @property
    def coefficients(self) -> Array:
        """a, (p,)."""
        known = np.array(self.autocovariances)
        return np.asarray(solve_toeplitz(known[:-1], known[1:]))

    @property
    def share(self) -> float:
        """Share of the variance that earlier values tell."""
        return float(self.coefficients @ self.autocovariances[1:])

    @property
    def correlation_time_s(self) -> float:
        """Time in which the slowest part of it is forgotten to 37 %."""
        slowest = float(np.abs(np.roots(np.concatenate([[1.0], -self.coefficients]))).max())
        return -self.step_s / math.log(slowest)

    @property
    def in_words(self) -> str:
        """Over what noise is correlated."""
        return f"from sample to sample, over {1000 * self.correlation_time_s:.0f} ms"

    @property
    def density(self) -> float:
        """Spectral density at frequency 0 of samples at every step / that of white noise."""
        return (1.0 - self.share) / (1.0 - float(self.coefficients.sum())) ** 2

    def numbers(self) -> dict[str, Any]:
        """Its coefficients, and the slowest part of it."""
        own = {"autoregression": self.coefficients.tolist(), "step_s": self.step_s}
        return {"correlation_time_s": self.correlation_time_s, "parts": [], **own}

    def of_means(self, share: float, step_s: float) -> tuple[float, Colour | None]:
        """Means of readings are an autoregression as well."""
        means = self.of_so_many(max(round(1.0 / share), 1))
        return math.sqrt(self.density / means.density), means

    def of_so_many(self, count: int) -> "Autoregression":
        """The autoregression of means of so many values, one after the other."""
        order = min(len(self.autocovariances) - 1, _MOST_OF_MEANS)
        lags = np.arange(order + 1) * count
        known = self._extended(int(lags[-1]) + count)
        within = np.arange(1 - count, count)
        pairs = known[np.abs(lags[:, None] + within)] @ (count - np.abs(within))
        return replace(
            self,
            autocovariances=tuple(float(own) for own in pairs / pairs[0]),
            step_s=count * self.step_s,
        )

    def _extended(self, size: int) -> Array:
        """Autocovariances at lags of 0 to size - 1 steps."""
        known, told = np.array(self.autocovariances), self.coefficients
        found = np.concatenate([known, np.zeros(max(size - known.size, 0))])
        for lag in range(known.size, size):
            found[lag] = told @ found[lag - 1 : lag - known.size : -1]
        return found

    def _filtered(self, time_s: Array, columns: Array, *, restored: bool) -> tuple[Array, float]:
        moved = np.diff(steps_of(time_s, self.step_s), prepend=-_FORGOTTEN_STEPS)
        moved = np.clip(moved, 1, _FORGOTTEN_STEPS)
        variances, rest = np.array(self.autocovariances[:-1]), 1.0 - self.share
        found: tuple[Array, float] = _filtered(
            moved, columns, self.coefficients, variances, rest, restored
        )
        return found


def steps_of(time_s: Array, step_s: float) -> NDArray[np.int64]:
    """Number of the step that each sample is at, (N,), from 0 on, where time stamps scatter.

    The length of a step is known to few digits, and trials are long: more and more samples tell it.
    """
    after_s, begin_s, told = time_s - time_s[:1], 0.0, _TELL_A_STEP
    while True:
        found = np.rint((after_s[:told] - begin_s) / step_s)
        if found.size > _TELL_A_STEP // 2 and found[-1] > found[0]:
            step_s, begin_s = np.polyfit(found, after_s[:told], 1)
        if told >= time_s.size:
            found = np.rint((after_s - begin_s) / step_s)
            return np.asarray(found - found[:1], np.int64)
        told *= 2


@njit(cache=True)
def _filtered(
    moved: NDArray[np.int64],
    values: Array,
    told: Array,
    autocovariances: Array,
    rest: float,
    restored: bool,
) -> tuple[Array, float]:
    """Innovations of readings, or readings of innovations, and the sum of log variances.

    Args:
      moved: steps since the sample before, (N,).
      told: coefficients, (p,).
      autocovariances: at lags from 0, (p,).
      rest: variance that p values before leave.
    """
    out, n, p = np.empty_like(values), values.shape[1], told.size
    mean, spread, known = np.zeros((p, n)), np.zeros((p, p)), False
    log_variance = 0.0
    for i in range(moved.size):
        if i == 0:
            for one in range(p):
                for other in range(p):
                    spread[one, other] = autocovariances[abs(one - other)]
        else:
            for _ in range(moved[i]):
                _advance(mean, spread, told, rest, known)
                known = False
        variance = max(spread[0, 0], rest)  # no more is told by any number of values before
        root = math.sqrt(variance)
        log_variance += math.log(variance)
        for j in range(n):
            missed = values[i, j] * root if restored else values[i, j] - mean[0, j]
            out[i, j] = mean[0, j] + missed if restored else missed / root
            for one in range(p):
                mean[one, j] += spread[one, 0] / variance * missed
        known = _read(spread)
    return out, log_variance


@njit(cache=True)
def _advance(mean: Array, spread: Array, told: Array, rest: float, known: bool) -> None:
    """State and covariance a step later, in place.

    Args:
      known: whether all values before are: then the covariance is 0 so far.
    """
    p, n = mean.shape
    for j in range(n):
        next_one = 0.0
        for one in range(p):
            next_one += told[one] * mean[one, j]
        for one in range(p - 1, 0, -1):
            mean[one, j] = mean[one - 1, j]
        mean[0, j] = next_one
    if known:
        spread[0, 0] = rest
        return
    across = spread @ told
    variance = rest
    for one in range(p):
        variance += told[one] * across[one]
    for one in range(p - 1, 0, -1):
        for other in range(p - 1, 0, -1):
            spread[one, other] = spread[one - 1, other - 1]
    for one in range(1, p):
        spread[one, 0] = spread[0, one] = across[one - 1]
    spread[0, 0] = variance


@njit(cache=True)
def _read(spread: Array) -> bool:
    """The covariance once the first value is known, in place, and whether all others are."""
    p, variance, left = spread.shape[0], spread[0, 0], 0.0
    gain = spread[:, 0].copy()
    for one in range(p):
        for other in range(p):
            spread[one, other] -= gain[one] * gain[other] / variance
        left = max(left, spread[one, one])
    if left > 1e-12:
        return False
    spread[:] = 0.0
    return True

"""Noise that is correlated in time: white noise beside first-order processes and oscillators.

The noise of a filtered or slowly wandering sensor is correlated, and so is that of one whose mount
swings. A share w of its variance is white; parts k have the shares c_k and the autocovariances

    c exp(-|t| / tau)                                               of an Ornstein-Uhlenbeck process,
    c exp(-|t| / tau) (cos(d t) + sin(d |t|) / (d tau))             of an oscillator in white noise,

with its natural frequency f and d^2 = (2 pi f)^2 - 1 / tau^2. At even steps these are AR(1) and
ARMA(2, 1) processes; several correlation times together are like 1/f noise. Means of n readings, each
at steps h, of an Ornstein-Uhlenbeck process of variance 1 have the autocovariances

    at lag 0      (n + 2 sum over k of (n - k) p^k) / n^2,   p = exp(-h / tau)
    at others     g exp(-|t| / tau),   g = ((1 - p^n) / (1 - p))^2 p^(1 - n) / n^2

g exceeds the variance, so that the shares may exceed 1 and w is then negative. Whitened noise is the
noise minus its prediction from the past, / standard deviation of the rest: the innovations of the
Kalman filter whose state x has one entry for each process, and two for each oscillator: its place,
and its rate / 2 pi f,

    e = y - h x,   S = h P h' + w,   K = P h' / S
    x <- F (x + K e),   P <- F (P - K K' S) F' + Q,   Q = c (1 - F F')

where h adds up the first entries, and F lets each part decay and swing for a step. This is exact for
samples at any times, also with missing ones (if w is negative, unless some are much closer than the step
of the means). It is linear in y: differences of residuals and slopes are whitened like residuals. The
sum of squares of whitened residuals is -2 log(likelihood), up to a constant.
"""

import math
from dataclasses import asdict, dataclass, replace
from typing import Any

import numpy as np
from numba import njit
from numpy.typing import NDArray

from diagnosis.prepare.noise.colour import Colour

Array = NDArray[np.float64]

_SLOW_FOR_A_SAMPLE = 0.2  # periods of an oscillation between means
_LEAST_VARIANCE = 1e-3  # of a sample that those before it predict, where times are too close for means


@dataclass(frozen=True, kw_only=True)
class ColouredPart:
    """A part of the noise of a sensor that is correlated in time.

    Attributes:
      share: share of the variance of the noise, above 0; above 1 for means of coloured readings.
      correlation_time_s: time in which it is forgotten to 37 %.
      frequency_hz: natural frequency of an oscillator, at least 1 / (2 pi correlation time); 0: none.
    """

    share: float
    correlation_time_s: float
    frequency_hz: float = 0.0

    def covariances(self, lags_s: Array) -> Array:
        """Autocovariances / its variance, (N,)."""
        apart_s = np.abs(lags_s)
        return np.asarray((self._amplitude * np.exp(-self._decay * apart_s)).real)

    def density(self, step_s: float) -> float:
        """Spectral density at frequency 0 of samples at even steps / that of white noise of its size."""
        kept = np.exp(-self._decay * step_s)
        return float(1.0 + 2.0 * (self._amplitude * kept / (1.0 - kept)).real)

    @property
    def _decay(self) -> complex:
        return complex(
            1.0 / self.correlation_time_s, -_swing(self.correlation_time_s, self.frequency_hz)
        )

    @property
    def _amplitude(self) -> complex:
        return complex(1.0, self._decay.real / self._decay.imag if self.frequency_hz else 0.0)


@dataclass(frozen=True, kw_only=True)
class NoiseColour(Colour):
    """Correlation in time of one sensor's noise, whatever its size.

    Attributes:
      parts: that are correlated, the one with most of the variance first; the rest is white.
      flicker: whether together they stand for flicker noise.
    """

    parts: tuple[ColouredPart, ...]
    flicker: bool = False

    @classmethod
    def of(cls, *, share: float, correlation_time_s: float) -> "NoiseColour":
        """White noise beside one Ornstein-Uhlenbeck process."""
        return cls(parts=(ColouredPart(share=share, correlation_time_s=correlation_time_s),))

    @property
    def share(self) -> float:
        """Share of the variance that is correlated in time."""
        return sum(part.share for part in self.parts)

    @property
    def in_words(self) -> str:
        """The times over which noise is correlated, or the frequencies at which it oscillates."""
        if self.flicker:
            return "as that of 1/f noise"
        each = (
            f"at {part.frequency_hz:.2g} Hz"
            if part.frequency_hz
            else f"over {1000 * part.correlation_time_s:.0f} ms"
            for part in self.parts
        )
        return " and ".join(each)

    def density(self, step_s: float) -> float:
        """Spectral density at frequency 0 of samples at even steps / that of white noise."""
        return 1.0 - self.share + sum(part.share * part.density(step_s) for part in self.parts)

    def numbers(self) -> dict[str, Any]:
        """All parts, and what of the largest."""
        largest, parts = self.parts[0], [asdict(part) for part in self.parts]
        return {"correlation_time_s": largest.correlation_time_s, "parts": parts}

    def of_means(self, share: float, step_s: float) -> tuple[float, Colour | None]:
        """Parts keep their correlation times; an oscillation that is fast for means is white."""
        slow = [p for p in self.parts if p.frequency_hz * step_s <= _SLOW_FOR_A_SAMPLE]
        fast = sum(p.share * p.density(step_s * share) for p in self.parts if p not in slow)
        sizes = [p.share * p.density(step_s * share) / p.density(step_s) for p in slow]
        total = 1 - self.share + fast + sum(sizes)
        each = zip(slow, sizes, strict=True)
        parts = tuple(replace(part, share=size / total) for part, size in each)
        return float(np.sqrt(total)), replace(self, parts=parts) if parts else None

    def _filtered(self, time_s: Array, columns: Array, *, restored: bool) -> tuple[Array, float]:
        table = np.array([(p.share, p.correlation_time_s, p.frequency_hz) for p in self.parts])
        steps_s = np.diff(time_s, prepend=-np.inf)
        found: tuple[Array, float] = _filtered(steps_s, columns, table, 1.0 - self.share, restored)
        return found


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
def _filtered(
    steps_s: Array, values: Array, parts: Array, white: float, restored: bool
) -> tuple[Array, float]:
    """Innovations of readings, or readings of innovations, and the sum of log variances.

    Args:
      parts: share, correlation time and frequency of each, (K, 3).
    """
    out, n = np.empty_like(values), values.shape[1]
    first = np.zeros(parts.shape[0] + 1, np.int64)  # entry of the state that each part is read at
    for k in range(parts.shape[0]):
        first[k + 1] = first[k] + (2 if parts[k, 2] > 0.0 else 1)
    size = first[-1]
    state, spread, gain = np.zeros((size, n)), np.zeros((size, size)), np.zeros(size)
    turn, log_variance = np.zeros((2, 2)), 0.0
    for i in range(steps_s.size):
        _advance(state, spread, turn, parts, first, steps_s[i])
        variance = white + _read(gain, spread, first)
        if variance < _LEAST_VARIANCE:  # a sample that is too close for means tells nothing
            variance = _LEAST_VARIANCE
            gain[:] = 0.0
        log_variance += math.log(variance)
        root = math.sqrt(variance)
        for j in range(n):
            known = 0.0
            for at in first[:-1]:
                known += state[at, j]
            missed = values[i, j] * root if restored else values[i, j] - known
            out[i, j] = known + missed if restored else missed / root
            for entry in range(size):
                state[entry, j] += gain[entry] / variance * missed
        for entry in range(size):
            for other in range(size):
                spread[entry, other] -= gain[entry] * gain[other] / variance
    return out, log_variance


@njit(cache=True)
def _read(gain: Array, spread: Array, first: NDArray[np.int64]) -> float:
    """P h', filled in, and h P h'."""
    for entry in range(gain.size):
        gain[entry] = 0.0
        for at in first[:-1]:
            gain[entry] += spread[entry, at]
    variance = 0.0
    for at in first[:-1]:
        variance += gain[at]
    return variance


@njit(cache=True)
def _advance(
    state: Array, spread: Array, turn: Array, parts: Array, first: NDArray[np.int64], step_s: float
) -> None:
    """State and covariance after a step, in place; `turn` is workspace, (2, 2)."""
    for k in range(parts.shape[0]):
        at, count = first[k], first[k + 1] - first[k]
        _advanced(turn, step_s, parts[k, 1], parts[k, 2])
        _turn(state, at, at + count, turn)
        _turn(spread, at, at + count, turn)
        _turn(spread.T, at, at + count, turn)
        for one in range(count):
            spread[at + one, at + one] += parts[k, 0]
            for other in range(count):
                kept = turn[one, 0] * turn[other, 0] + turn[one, 1] * turn[other, 1]
                spread[at + one, at + other] -= parts[k, 0] * kept


@njit(cache=True)
def _swing(time_s: float, frequency_hz: float) -> float:
    """Rate at which a part swings while it decays, rad/s."""
    if frequency_hz == 0.0:
        return 0.0
    return math.sqrt((2.0 * math.pi * frequency_hz) ** 2 - 1.0 / time_s**2)


@njit(cache=True)
def _advanced(turn: Array, step_s: float, time_s: float, frequency_hz: float) -> None:
    """Fills in F of one part for a step: its first entry, or all four."""
    kept, swing = math.exp(-step_s / time_s), _swing(time_s, frequency_hz)
    turn[:] = 0.0
    turn[0, 0] = kept
    if swing > 0.0 and kept > 0.0:
        along, across = kept * math.cos(swing * step_s), kept * math.sin(swing * step_s)
        damped, natural = across / (swing * time_s), across * 2.0 * math.pi * frequency_hz / swing
        turn[0, 0], turn[0, 1] = along + damped, natural
        turn[1, 0], turn[1, 1] = -natural, along - damped


@njit(cache=True)
def _turn(rows: Array, first: int, end: int, turn: Array) -> None:
    """Applies F of one part to its rows."""
    for j in range(rows.shape[1]):
        one, other = rows[first, j], rows[end - 1, j]
        rows[first, j] = turn[0, 0] * one + turn[0, 1] * other
        if end - first == 2:
            rows[first + 1, j] = turn[1, 0] * one + turn[1, 1] * other

"""An autoregression for the noise in residuals of readings at even steps.

Its autocovariances are those of the spectrum that a low quantile of the periodograms of windows shows
(`periodograms`): the inverse Fourier transform of it, / that of the taper. Below `COLOUR_ABOVE_HZ`,
where residuals of effects are, the spectrum is taken as level, so that what is slow is never taken for
noise. From `COLOUR_OSCILLATES_ABOVE_HZ` on, where effects leave nothing, the mean of the periodograms is
used: errors of the replay, which the noise does not cover there, are in it. The order p is the one
with the least N log(s^2) + p log(N), where N is half of the samples: windows overlap, and a quantile
tells less than a mean.

Missing values are first straight lines between their neighbours, then drawn from what the autoregression
that was found says of them, given all that were read, and so on: each round leaves of the first error
about the share of what is missing.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_toeplitz

from diagnosis.criteria.noise import (
    COLOUR_ABOVE_HZ,
    COLOUR_MOST_ORDER,
    COLOUR_OSCILLATES_ABOVE_HZ,
    COLOUR_WINDOWS,
)
from diagnosis.log.trial import sampled_at
from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.spectrum.missing_values import completed
from diagnosis.prepare.noise.spectrum.periodograms import (
    MEAN,
    QUANTILE,
    even,
    periodogram,
    step_of,
    taper_of,
    windows_of,
)

Array = NDArray[np.float64]

_LEVEL = 2.0  # the spectrum is level below a frequency as it is from there to so many times as much
_TOLD = 0.5  # of the samples
_FILLS, _SEED = 4, 0


def autoregression(parts: Sequence[tuple[Array, Array]]) -> tuple[float, Autoregression] | None:
    """Standard deviation and correlation of the noise; None: white, or the samples do not tell.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
    """
    parts = [part for part in parts if np.isfinite(part[1]).any()]
    step_s = step_of(parts)
    if np.isnan(step_s) or not all(sampled_at(time_s, step_s) for time_s, _ in parts):
        return None
    evens = [even(time_s, values, step_s) for time_s, values in parts]
    if len(windows_of(evens, step_s)) < COLOUR_WINDOWS:
        return None
    filled = [_interpolated(values) for values in evens]
    found, rng = _told_by(evens, filled, step_s), np.random.default_rng(_SEED)
    if all(np.isfinite(values).all() for values in evens):
        return found
    for _ in range(_FILLS):
        if found:
            sigma, own = found
            filled = [sigma * completed(own, values / sigma, rng) for values in evens]
        else:
            filled = [_completed_white(values, rng) for values in evens]
        found = _told_by(evens, filled, step_s)
    return found


def _told_by(
    evens: Sequence[Array], filled: Sequence[Array], step_s: float
) -> tuple[float, Autoregression] | None:
    """What values at every step tell; of their windows those count that were read."""
    known = _autocovariances(windows_of(evens, step_s, filled), step_s)
    samples = _TOLD * sum(np.isfinite(values).sum() for values in evens)
    rests = _rests(known)
    order = int(np.argmin(samples * np.log(rests) + np.arange(rests.size) * np.log(samples)))
    if order == 0:
        return None
    shown = tuple(float(own) for own in known[: order + 1] / known[0])
    return float(np.sqrt(known[0])), Autoregression(autocovariances=shown, step_s=step_s)


def _interpolated(values: Array) -> Array:
    """Values with straight lines where none was read."""
    read = np.isfinite(values)
    return np.interp(np.arange(values.size), np.flatnonzero(read), values[read])


def _completed_white(values: Array, rng: np.random.Generator) -> Array:
    """Values with white noise of their own size where none was read."""
    return np.where(np.isfinite(values), values, np.nanstd(values) * rng.normal(size=values.size))


def _autocovariances(cut: Sequence[Array], step_s: float) -> Array:
    """Of the noise in windows, at lags of 0, 1, ... steps."""
    size = cut[0].size
    taper, frequencies = taper_of(size), np.fft.rfftfreq(size, step_s)
    each = np.array([periodogram(values, taper) for values in cut])
    shown = np.quantile(each, QUANTILE, axis=0) / MEAN
    fast = frequencies >= COLOUR_OSCILLATES_ABOVE_HZ
    shown[fast] = each[:, fast].mean(axis=0)
    slow, next_to = frequencies < COLOUR_ABOVE_HZ, frequencies < _LEVEL * COLOUR_ABOVE_HZ
    shown[slow] = shown[next_to & ~slow].mean()
    lags = min(COLOUR_MOST_ORDER, size // 4) + 1
    own = np.abs(np.fft.rfft(taper, 2 * size)) ** 2
    pairs = np.fft.irfft(own)[:lags]
    return np.asarray(np.fft.irfft(shown, size)[:lags] * pairs[0] / pairs)


def _rests(known: Array) -> Array:
    """Shares of the variance that 0, 1, ... values before leave, as far as that is a covariance."""
    rests = [1.0]
    for order in range(1, known.size):
        told = solve_toeplitz(known[:order], known[1 : order + 1])
        rest = float(1.0 - told @ known[1 : order + 1] / known[0])
        if not 0.0 < rest <= rests[-1] * (1.0 + 1e-9):
            break
        rests.append(rest)
    return np.array(rests)

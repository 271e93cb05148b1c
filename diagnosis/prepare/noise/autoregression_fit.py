"""An autoregression for the noise in residuals of readings at even steps.

Its autocovariances are those of the spectrum that a low quantile of the periodograms of windows shows
(`periodograms`): the inverse Fourier transform of it, / that of the windows themselves, in which samples
are missing. Below `COLOUR_ABOVE_HZ`, where residuals of effects are, the spectrum is taken as level, so
that what is slow is never taken for noise. The order p is the one with the least N log(s^2) + p log(N),
where N is half of the samples: windows overlap, and a quantile tells less than a mean.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_toeplitz

from diagnosis.criteria import COLOUR_ABOVE_HZ, COLOUR_MOST_ORDER, COLOUR_WINDOWS
from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.periodograms import (
    MEAN,
    QUANTILE,
    periodogram,
    step_of,
    taper_of,
    windows_of,
)

Array = NDArray[np.float64]

_LEVEL = 2.0  # the spectrum is level below a frequency as it is from there to so many times as much
_SAME_STEP = 0.02  # relative difference between the steps of trials
_TOLD = 0.5  # of the samples


def autoregression(parts: Sequence[tuple[Array, Array]]) -> tuple[float, Autoregression] | None:
    """Standard deviation and correlation of the noise; None: white, or the samples do not tell.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
    """
    step_s = step_of(parts)
    if np.isnan(step_s) or not all(_has_step(time_s, step_s) for time_s, _ in parts):
        return None
    cut = windows_of(parts, step_s)
    if len(cut) < COLOUR_WINDOWS:
        return None
    known = _autocovariances(cut, step_s)
    samples = _TOLD * sum(np.isfinite(values).sum() for _, values in parts)
    rests = _rests(known)
    order = int(np.argmin(samples * np.log(rests) + np.arange(rests.size) * np.log(samples)))
    if order == 0:
        return None
    shown = tuple(float(own) for own in known[: order + 1] / known[0])
    return float(np.sqrt(known[0])), Autoregression(autocovariances=shown, step_s=step_s)


def _has_step(time_s: Array, step_s: float) -> bool:
    return time_s.size < 2 or abs(float(np.median(np.diff(time_s))) / step_s - 1.0) < _SAME_STEP


def _autocovariances(cut: Sequence[Array], step_s: float) -> Array:
    """Of the noise in windows, at lags of 0, 1, ... steps."""
    size = cut[0].size
    taper, frequencies = taper_of(size), np.fft.rfftfreq(size, step_s)
    shown = np.quantile([periodogram(values, taper) for values in cut], QUANTILE, axis=0) / MEAN
    slow, next_to = frequencies < COLOUR_ABOVE_HZ, frequencies < _LEVEL * COLOUR_ABOVE_HZ
    shown[slow] = shown[next_to & ~slow].mean()
    lags = min(COLOUR_MOST_ORDER, size // 4) + 1
    masks = np.array([np.isfinite(values) * taper for values in cut])
    pairs = np.fft.irfft((np.abs(np.fft.rfft(masks, 2 * size)) ** 2).mean(axis=0))[:lags]
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

"""Levels of a spectrum in bands of frequencies, and what models of the noise are expected to show there.

The residual is cut into windows of 2 s, a parabola is subtracted from each, and a low quantile of the
periodograms is used in each band (`periodograms`). Missing samples count as zeros; the autocorrelation
of the windows takes this into account in the spectrum that a model of the noise is expected to show.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from diagnosis.criteria.log import SAME_STEP
from diagnosis.criteria.noise import (
    COLOUR_ABOVE_HZ,
    COLOUR_LONGEST_S,
    COLOUR_WINDOW_S,
    COLOUR_WINDOWS,
)
from diagnosis.prepare.noise.noise_colour import ColouredPart, covariances_of_means
from diagnosis.prepare.noise.spectrum.periodograms import (
    MEAN,
    QUANTILE,
    even,
    periodogram,
    step_of,
    steps_of_trials,
    taper_of,
    trend,
    windows_of,
)

Array = NDArray[np.float64]

_BANDS = 12
_TIMES = 32  # correlation times that are tried
_SCATTER = np.sqrt(QUANTILE / (1 - QUANTILE)) / MEAN  # of ln(quantile), times sqrt(samples)
_INDEPENDENT = 0.8  # of the periodograms of half overlapping windows, at neighbouring frequencies
_FEWEST_BANDS = 4
_MASKS, _IN_BAND = 12, 8  # windows and frequencies that stand for all
_SHORTEST = 0.4  # steps, the shortest correlation time that is tried


@dataclass(frozen=True, kw_only=True, eq=False)
class NoiseLevels:
    """Levels of bands, (B,), the standard deviations of their logarithms, and how to predict them."""

    levels: Array
    error: Array
    lag_weights: Array
    step_s: float

    @property
    def lags_s(self) -> Array:
        """Lags of the autocovariances that predict levels, (L,)."""
        return np.asarray(self.step_s * np.arange(self.lag_weights.shape[1]), float)

    @property
    def white(self) -> Array:
        """Levels that white noise of variance 1 is expected to show, (B,)."""
        return self.expected((self.lags_s == 0).astype(float))

    def expected(self, covariances: Array) -> Array:
        """Levels that noise of given autocovariances at lags 0, 1, ... is expected to show, (B,)."""
        return self.lag_weights @ covariances

    def fitted(self, columns: Array) -> tuple[float, Array]:
        """Chi-square of the best non-negative sum of columns, (B, C), and its coefficients, (C,)."""
        size = self.levels
        for _ in range(4):  # scatter is a share of what is expected, not of what was found
            weights = 1 / (self.error * size)
            coefficients, _ = nnls(columns * weights[:, None], self.levels * weights)
            size = np.sqrt(size * np.maximum(columns @ coefficients, 1e-12 * size))
        ratio = np.log(self.levels / np.maximum(columns @ coefficients, 1e-300))
        return float(np.sum((ratio / self.error) ** 2)), coefficients


@dataclass(frozen=True, kw_only=True, eq=False)
class NoiseShape:
    """A part of the noise of any size, and what it adds to the levels of a spectrum, (B,).

    Attributes:
      part: with the share of one whose readings have the variance 1.
      variance_ratio: of samples, which may be means of readings, to that of readings.
    """

    part: ColouredPart
    variance_ratio: float
    levels: Array


def processes(spectrum: NoiseLevels, means_of: int) -> list[NoiseShape]:
    """Ornstein-Uhlenbeck processes of all correlation times that are tried.

    Args:
      means_of: number of readings that a sample is the mean of.
    """
    times_s = np.geomspace(_SHORTEST * spectrum.step_s, COLOUR_LONGEST_S, _TIMES)
    return [process(spectrum, float(time_s), means_of) for time_s in times_s]


def process(spectrum: NoiseLevels, time_s: float, means_of: int) -> NoiseShape:
    """An Ornstein-Uhlenbeck process of a correlation time."""
    covariances, later = covariances_of_means(spectrum.lags_s, time_s, spectrum.step_s, means_of)
    part = ColouredPart(share=later, correlation_time_s=time_s)
    return NoiseShape(
        part=part, variance_ratio=float(covariances[0]), levels=spectrum.expected(covariances)
    )


def spectrum_of(
    parts: Sequence[tuple[Array, Array]],
    above_hz: float = COLOUR_ABOVE_HZ,
    window_s: float = COLOUR_WINDOW_S,
) -> NoiseLevels | None:
    """The spectrum of all trials; None: they are too short.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
      above_hz: frequency at which bands begin.
      window_s: of the windows.
    """
    step_s, cut = _enough_windows(parts, window_s)
    if not cut:
        return None
    size = cut[0].size
    taper, frequencies = taper_of(size), np.fft.rfftfreq(size, step_s)
    # The last, of half the sampling rate, has no phase: it scatters more, and its low quantile is lower.
    edges = np.geomspace(above_hz, max(frequencies[-1], 1.001 * above_hz), _BANDS + 1)
    inside = [np.flatnonzero((frequencies >= a) & (frequencies < b)) for a, b in pairwise(edges)]
    bands = [own for own in inside if own.size]
    if len(bands) < _FEWEST_BANDS:
        return None
    squares = np.array([periodogram(values, taper) for values in cut])
    levels = np.array([np.quantile(squares[:, own], QUANTILE) / MEAN for own in bands])
    if not (levels > 0).all():
        return None
    count = np.array([_INDEPENDENT * len(cut) * own.size for own in bands])
    return NoiseLevels(
        levels=levels,
        error=_SCATTER / np.sqrt(count),
        lag_weights=_lag_weights(cut, taper, bands),
        step_s=step_s,
    )


def _enough_windows(parts: Sequence[tuple[Array, Array]], window_s: float) -> tuple[float, list[Array]]:
    """Windows of all trials at one step, s, and that step; none: the trials are too short.

    The step is that of most samples, or else a longer one of slower trials, at which of faster ones
    some samples are used. Those that are slower still are not: every other value would be missing.
    """
    for step_s in steps_of_trials(parts):
        fast = [part for part in parts if step_of([part]) <= (1 + SAME_STEP) * step_s]
        evens = [even(time_s, values, step_s) for time_s, values in fast]
        cut = windows_of(evens, step_s, window_s=window_s)
        if len(cut) >= COLOUR_WINDOWS:
            return step_s, cut
    return np.nan, []


def _lag_weights(cut: Sequence[Array], taper: Array, bands: Sequence[NDArray[np.int_]]) -> Array:
    """Weights with which autocovariances at lags 0, 1, ... give the expected levels of bands, (B, L)."""
    masks = list({np.isfinite(one).tobytes(): one for one in cut}.values())
    looked_at = masks[:: max(len(masks) // _MASKS, 1)]
    each = []
    for values in looked_at:
        known, weights, scale = trend(values, taper)
        base, inverse = known, np.linalg.pinv(known)
        size = values.size
        rows = []
        for own in bands:
            some = own[:: max(own.size // _IN_BAND, 1)]
            waves = np.exp(-2j * np.pi * np.outer(some, np.arange(size)) / size) * weights
            waves = waves - (waves @ base) @ inverse
            power = np.mean(np.abs(np.fft.fft(waves, 2 * size)) ** 2, axis=0)
            overlap = np.fft.ifft(power).real[:size] / scale
            rows.append(np.where(np.arange(size) == 0, overlap, 2 * overlap))
        each.append(np.array(rows))
    return np.asarray(np.mean(each, axis=0))

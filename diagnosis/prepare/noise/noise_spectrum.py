"""Colour of a sensor's noise, from the spectrum of the residual of its readings.

The residual due to an unmodelled effect is slow, or comes in bursts with motions; noise is always there.
So the residual is cut into windows of 2 s, a parabola is subtracted from each, and a low quantile of
the periodograms is used in each band of frequencies. For noise this quantile is known (a periodogram
scatters as chi-square with two degrees of freedom about the spectral density), and bursts in two thirds
of the windows do not change it. Bands begin above the frequencies of slow residuals. The sum of white
noise and an Ornstein-Uhlenbeck process is fitted to them (`noise_colour`), with a correlation time of
at most `COLOUR_LONGEST_S`: its part below the bands is extrapolated and never taken from the data.
So missing slow friction cannot be mistaken for noise. Beside an explanation that leaves little, further
parts are added one by one where the spectrum asks for them: another such process, or an oscillator that
is faster than what needles do. Noise that a digital filter has limited to a band is no sum of these:
there an autoregression takes their place, if it is clearly likelier (`autoregression_fit`).

Missing samples count as zeros; the autocorrelation of the windows takes this into account in the
spectrum that a model of the noise is expected to show.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import nnls

from diagnosis.criteria import (
    COLOUR_ABOVE_HZ,
    COLOUR_CHI_SQUARE,
    COLOUR_LEAST_PART,
    COLOUR_LEAST_SHARE,
    COLOUR_LONGEST_S,
    COLOUR_MOST_PARTS,
    COLOUR_OPEN,
    COLOUR_OSCILLATES_ABOVE_HZ,
    COLOUR_OSCILLATOR,
    COLOUR_WINDOW_S,
    COLOUR_WINDOWS,
)
from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.autoregression_fit import autoregression
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour, covariances_of_means
from diagnosis.prepare.noise.periodograms import (
    MEAN,
    QUANTILE,
    even,
    periodogram,
    step_of,
    taper_of,
    trend,
    windows_of,
)

Array = NDArray[np.float64]

_BANDS = 12
_TIMES = 32  # correlation times that are tried
_FREQUENCIES, _QUALITIES = 24, (0.55, 0.8, 1.2, 1.8, 2.7, 4.0, 6.0)  # of oscillators that are tried
_OSCILLATES_BELOW = 0.4  # periods per sample
_SCATTER = np.sqrt(QUANTILE / (1 - QUANTILE)) / MEAN  # of ln(quantile), times sqrt(samples)
_INDEPENDENT = 0.8  # of the periodograms of half overlapping windows, at neighbouring frequencies
_FEWEST_BANDS = 4
_MASKS, _IN_BAND = 12, 8  # windows and frequencies that stand for all


@dataclass(frozen=True, kw_only=True, eq=False)
class _Spectrum:
    """Levels of bands, (B,), the standard deviations of their logarithms, and how to predict them."""

    levels: Array
    error: Array
    lag_weights: Array
    step_s: float

    def expected(self, covariances: Array) -> Array:
        """Levels that noise of given autocovariances at lags 0, 1, ... is expected to show, (B,)."""
        return self.lag_weights @ covariances


@dataclass(frozen=True, kw_only=True, eq=False)
class _Shape:
    """A part of the noise of any size, and what it adds to the levels of a spectrum, (B,).

    Attributes:
      part: with the share of one whose readings have the variance 1.
      variance_ratio: of samples, which may be means of readings, to that of readings.
    """

    part: ColouredPart
    variance_ratio: float
    levels: Array


@dataclass(frozen=True, kw_only=True, eq=False)
class _Sized:
    """A model of the noise that was fitted to a spectrum, with its chi-square."""

    cost: float
    sigma: float
    colour: NoiseColour
    shapes: tuple[_Shape, ...]


def noise_colour(
    parts: Sequence[tuple[Array, Array]],
    least_share: float = COLOUR_LEAST_SHARE,
    means_of: int = 1,
    least_chi_square: float = COLOUR_CHI_SQUARE,
    most_parts: int = COLOUR_MOST_PARTS,
) -> tuple[float, Colour] | None:
    """Standard deviation and colour of the noise in residuals; None: it may be white.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
      least_share: smallest share of the variance that counts as coloured.
      means_of: number of readings that a sample is the mean of.
      least_chi_square: by which white noise has to fit the spectrum worse.
      most_parts: correlated parts; the only one does not oscillate.
    """
    spectrum = _spectrum(parts)
    if spectrum is None:
        return None
    lags_s = np.asarray(spectrum.step_s * np.arange(spectrum.lag_weights.shape[1]), float)
    white = spectrum.expected((lags_s == 0).astype(float))
    cost, _ = _fitted(spectrum, white[:, None])
    shapes = _processes(spectrum, lags_s, means_of)
    if most_parts > 1:
        shapes += _oscillators(spectrum, lags_s)
    found: tuple[float, NoiseColour] | None = None
    chosen: list[_Shape] = []
    asked = least_chi_square
    while len(chosen) < most_parts:
        tried = [_sized(spectrum, white, (*chosen, shape)) for shape in shapes]
        there = [
            own for own in tried if own and min(p.share for p in own.colour.parts) > COLOUR_LEAST_PART
        ]
        best = min((own.cost for own in there), default=cost)
        if cost - best < asked:
            break
        open_ = [own for own in there if own.cost <= best + COLOUR_OPEN]
        kept = min(open_, key=lambda own: _unlikeliness(parts, own.colour))
        found, chosen, cost = (kept.sigma, kept.colour), list(kept.shapes), kept.cost
        asked = COLOUR_CHI_SQUARE
    if found is None or found[1].share < least_share:
        return None
    return _likelier(parts, found, autoregression(parts)) if most_parts > 1 else found


def _processes(spectrum: _Spectrum, lags_s: Array, means_of: int) -> list[_Shape]:
    """Ornstein-Uhlenbeck processes of all correlation times."""
    found = []
    for time_s in np.geomspace(0.4 * spectrum.step_s, COLOUR_LONGEST_S, _TIMES):
        covariances, later = covariances_of_means(lags_s, time_s, spectrum.step_s, means_of)
        part = ColouredPart(share=later, correlation_time_s=float(time_s))
        found.append(
            _Shape(part=part, variance_ratio=covariances[0], levels=spectrum.expected(covariances))
        )
    return found


def _oscillators(spectrum: _Spectrum, lags_s: Array) -> list[_Shape]:
    """Oscillators above the frequencies of effects."""
    found, fastest_hz = list[_Shape](), _OSCILLATES_BELOW / spectrum.step_s
    if fastest_hz <= COLOUR_OSCILLATES_ABOVE_HZ:
        return found
    for frequency in np.geomspace(COLOUR_OSCILLATES_ABOVE_HZ, fastest_hz, _FREQUENCIES):
        for quality in _QUALITIES:
            time_s = float(quality / (np.pi * frequency))
            part = ColouredPart(share=1.0, correlation_time_s=time_s, frequency_hz=float(frequency))
            levels = spectrum.expected(part.covariances(lags_s))
            found.append(_Shape(part=part, variance_ratio=1.0, levels=levels))
    return found


def _sized(spectrum: _Spectrum, white: Array, shapes: Sequence[_Shape]) -> _Sized | None:
    """White noise and parts of these shapes, fitted to a spectrum; None: the last one is not there."""
    cost, sizes = _fitted(spectrum, np.column_stack([white, *(shape.levels for shape in shapes)]))
    if sizes[-1] <= 0:
        return None
    there = [(shape, size) for shape, size in zip(shapes, sizes[1:], strict=True) if size > 0]
    variance = float(sizes[0] + sum(size * shape.variance_ratio for shape, size in there))
    ranked = sorted(there, key=lambda own: -own[1] * own[0].variance_ratio)
    parts = tuple(
        replace(shape.part, share=float(size * shape.part.share / variance)) for shape, size in ranked
    )
    return _Sized(
        cost=cost + COLOUR_OSCILLATOR * sum(part.frequency_hz > 0.0 for part in parts),
        sigma=float(np.sqrt(variance)),
        colour=NoiseColour(parts=parts),
        shapes=tuple(shape for shape, _ in there),
    )


def _likelier(
    parts: Sequence[tuple[Array, Array]],
    found: tuple[float, NoiseColour],
    other: tuple[float, Autoregression] | None,
) -> tuple[float, Colour]:
    """The parts that were found, or an autoregression that is clearly likelier."""
    if other is None:
        return found
    order, samples = other[1].coefficients.size, sum(np.isfinite(values).sum() for _, values in parts)
    lead = _unlikeliness(parts, found[1]) - _unlikeliness(parts, other[1])
    return other if lead > COLOUR_CHI_SQUARE + order * np.log(samples) else found


def _unlikeliness(parts: Sequence[tuple[Array, Array]], colour: Colour) -> float:
    """-2 log(likelihood) of residuals whose noise has a colour, and any size."""
    squares, uncertainty, samples = 0.0, 0.0, 0
    for time_s, values in parts:
        read = np.isfinite(values)
        squares += float(np.sum(colour.whitened(time_s[read], values[read]) ** 2))
        uncertainty += colour.uncertainty(time_s[read])
        samples += int(read.sum())
    return samples * float(np.log(squares)) + uncertainty


def _fitted(spectrum: _Spectrum, columns: Array) -> tuple[float, Array]:
    """Chi-square of the best non-negative sum of columns, and its coefficients."""
    size = spectrum.levels
    for _ in range(4):  # scatter is a share of what is expected, not of what was found
        weights = 1 / (spectrum.error * size)
        coefficients, _ = nnls(columns * weights[:, None], spectrum.levels * weights)
        size = np.sqrt(size * np.maximum(columns @ coefficients, 1e-12 * size))
    ratio = np.log(spectrum.levels / np.maximum(columns @ coefficients, 1e-300))
    return float(np.sum((ratio / spectrum.error) ** 2)), coefficients


def _spectrum(parts: Sequence[tuple[Array, Array]]) -> _Spectrum | None:
    """The spectrum of all trials; None: they are too short."""
    step_s = step_of(parts)
    if np.isnan(step_s):
        return None
    size = round(COLOUR_WINDOW_S / step_s)
    evens = [even(time_s, values, step_s) for time_s, values in parts]
    taper, cut = taper_of(size), windows_of(evens, step_s)
    frequencies = np.fft.rfftfreq(size, step_s)
    edges = np.geomspace(COLOUR_ABOVE_HZ, max(frequencies[-1], COLOUR_ABOVE_HZ) * 1.001, _BANDS + 1)
    inside = [np.flatnonzero((frequencies >= a) & (frequencies < b)) for a, b in pairwise(edges)]
    bands = [own for own in inside if own.size]
    if len(cut) < COLOUR_WINDOWS or len(bands) < _FEWEST_BANDS:
        return None
    squares = np.array([periodogram(values, taper) for values in cut])
    levels = np.array([np.quantile(squares[:, own], QUANTILE) / MEAN for own in bands])
    if not (levels > 0).all():
        return None
    count = np.array([_INDEPENDENT * len(cut) * own.size for own in bands])
    return _Spectrum(
        levels=levels,
        error=_SCATTER / np.sqrt(count),
        lag_weights=_lag_weights(cut, taper, bands),
        step_s=step_s,
    )


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

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
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.noise import (
    COLOUR_CHI_SQUARE,
    COLOUR_LEAST_PART,
    COLOUR_LEAST_SHARE,
    COLOUR_MOST_PARTS,
    COLOUR_OPEN,
    COLOUR_OSCILLATES_ABOVE_HZ,
    COLOUR_OSCILLATOR,
)
from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.colour import Colour
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour
from diagnosis.prepare.noise.spectrum.autoregression_fit import autoregression
from diagnosis.prepare.noise.spectrum.levels import NoiseLevels, NoiseShape, processes, spectrum_of

Array = NDArray[np.float64]

_FREQUENCIES, _QUALITIES = 24, (0.55, 0.8, 1.2, 1.8, 2.7, 4.0, 6.0)  # of oscillators that are tried
_OSCILLATES_BELOW = 0.4  # periods per sample


@dataclass(frozen=True, kw_only=True, eq=False)
class _Sized:
    """A model of the noise that was fitted to a spectrum, with its chi-square."""

    cost: float
    sigma: float
    colour: NoiseColour
    shapes: tuple[NoiseShape, ...]


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
    spectrum = spectrum_of(parts)
    if spectrum is None:
        return None
    white = spectrum.white
    cost, _ = spectrum.fitted(white[:, None])
    shapes = processes(spectrum, means_of)
    if most_parts > 1:
        shapes += _oscillators(spectrum)
    found: tuple[float, NoiseColour] | None = None
    chosen: list[NoiseShape] = []
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
        kept = min(open_, key=lambda own: unlikeliness(parts, own.colour))
        found, chosen, cost = (kept.sigma, kept.colour), list(kept.shapes), kept.cost
        asked = COLOUR_CHI_SQUARE
    if found is None or found[1].share < least_share:
        return None
    return _likelier(parts, found, autoregression(parts)) if most_parts > 1 else found


def _oscillators(spectrum: NoiseLevels) -> list[NoiseShape]:
    """Oscillators above the frequencies of effects."""
    found, fastest_hz = list[NoiseShape](), _OSCILLATES_BELOW / spectrum.step_s
    if fastest_hz <= COLOUR_OSCILLATES_ABOVE_HZ:
        return found
    for frequency in np.geomspace(COLOUR_OSCILLATES_ABOVE_HZ, fastest_hz, _FREQUENCIES):
        for quality in _QUALITIES:
            time_s = float(quality / (np.pi * frequency))
            part = ColouredPart(share=1.0, correlation_time_s=time_s, frequency_hz=float(frequency))
            levels = spectrum.expected(part.covariances(spectrum.lags_s))
            found.append(NoiseShape(part=part, variance_ratio=1.0, levels=levels))
    return found


def _sized(spectrum: NoiseLevels, white: Array, shapes: Sequence[NoiseShape]) -> _Sized | None:
    """White noise and parts of these shapes, fitted to a spectrum; None: the last one is not there."""
    cost, sizes = spectrum.fitted(np.column_stack([white, *(shape.levels for shape in shapes)]))
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
    lead = unlikeliness(parts, found[1]) - unlikeliness(parts, other[1])
    return other if lead > COLOUR_CHI_SQUARE + order * np.log(samples) else found


def unlikeliness(parts: Sequence[tuple[Array, Array]], colour: Colour) -> float:
    """-2 log(likelihood) of residuals whose noise has a colour, and any size."""
    squares, uncertainty, samples = 0.0, 0.0, 0
    for time_s, values in parts:
        read = np.isfinite(values)
        squares += float(np.sum(colour.whitened(time_s[read], values[read]) ** 2))
        uncertainty += colour.uncertainty(time_s[read])
        samples += int(read.sum())
    return samples * float(np.log(squares)) + uncertainty

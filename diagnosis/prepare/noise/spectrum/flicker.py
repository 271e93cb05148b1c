"""Slow noise: flicker noise, whose spectral density is as 1 / f, as of amplifiers and strain gauges.

Processes whose correlation times are even on a logarithmic scale, with variances as these times to the
power of a - 1, have a density as 1 / f^a between 1 / (2 pi) of the longest and of the shortest of these
times; here those are that of a wave as long as a trial and the step of the samples. a is 1, or a little
more. Its size beside white noise is fitted to the spectrum above a frequency (`levels`); below, it is
extrapolated and never taken from the data. Where that is the frequency above which effects leave little,
noise has to be coloured there for most of it to be seen; of an amplifier whose flicker begins at 1 Hz
nothing is. So the spectrum is also looked at from `FLICKER_ABOVE_HZ` on. There slow residuals of effects
may pass for noise: what that asks for besides is in `selection/stages/sensors/coloured_noise.py`. From
there on a single process shows how long it lasts, even where that is longer than `COLOUR_LONGEST_S`, and
takes the place of 1 / f where it is likelier.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.noise import (
    COLOUR_ABOVE_HZ,
    COLOUR_LONGEST_S,
    COLOUR_OPEN,
    COLOUR_WINDOW_S,
    FLICKER_EXPONENTS,
)
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour
from diagnosis.prepare.noise.spectrum.levels import (
    NoiseLevels,
    NoiseShape,
    process,
    processes,
    spectrum_of,
)
from diagnosis.prepare.noise.spectrum.noise_spectrum import unlikeliness

Array = NDArray[np.float64]
Sized = tuple[NoiseShape, float]  # a process, and its share of the variance of all

_WAVES = COLOUR_WINDOW_S * COLOUR_ABOVE_HZ
_TIMES = 8  # correlation times: the density is within some per cent of 1 / f
_SHOWN = 2.0  # times 2 pi f of the lowest frequency: its density is 0.8 of what it falls as there


@dataclass(frozen=True, kw_only=True)
class Flicker:
    """Flicker noise beside white noise.

    Attributes:
      gain_cost: chi-square by which white noise alone fits the spectrum worse.
      behind_cost: by which the best process of one correlation time fits it better.
      noise: standard deviation and colour.
    """

    gain_cost: float
    behind_cost: float
    noise: tuple[float, NoiseColour]


def flicker_noise(
    parts: Sequence[tuple[Array, Array]],
    means_of: int = 1,
    above_hz: float = COLOUR_ABOVE_HZ,
) -> Flicker | None:
    """Flicker noise in residuals, or a slow process if that is likelier; None: neither, or too short.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
      means_of: number of readings that a sample is the mean of.
      above_hz: frequency above which the spectrum is looked at, in windows of three waves of it.
    """
    spectrum = spectrum_of(parts, above_hz, _WAVES / above_hz)
    if spectrum is None:
        return None
    slowest_s = max(time_s[-1] - time_s[0] for time_s, _ in parts) / (2.0 * np.pi)
    fast = _processes(spectrum, spectrum.step_s, slowest_s, means_of)
    tried = [_as_powers(fast, exponent) for exponent in FLICKER_EXPONENTS]
    longest_s = _SHOWN / (2.0 * np.pi * above_hz)
    if longest_s > COLOUR_LONGEST_S:
        tried += [
            ((own, 1.0),) for own in _processes(spectrum, COLOUR_LONGEST_S, longest_s, means_of)[1:]
        ]
    sized = [_sized(spectrum, own) for own in tried]
    least = min(cost for cost, _ in sized)
    open_ = [(cost, noise) for cost, noise in sized if noise and cost <= least + COLOUR_OPEN]
    if not open_:
        return None
    cost, noise = min(open_, key=lambda own: unlikeliness(parts, own[1][1]))
    alone, _ = spectrum.fitted(spectrum.white[:, None])
    quick = min(_sized(spectrum, ((own, 1.0),))[0] for own in processes(spectrum, means_of))
    return Flicker(gain_cost=alone - cost, behind_cost=cost - quick, noise=noise)


def _processes(
    spectrum: NoiseLevels, shortest_s: float, longest_s: float, means_of: int
) -> list[NoiseShape]:
    """Processes whose correlation times are even on a logarithmic scale."""
    times_s = np.geomspace(shortest_s, longest_s, _TIMES)
    return [process(spectrum, float(time_s), means_of) for time_s in times_s]


def _as_powers(shapes: Sequence[NoiseShape], exponent: float) -> tuple[Sized, ...]:
    """Processes with the shares of the variance that have a density as 1 / f to a power."""
    sizes = np.array([shape.part.correlation_time_s for shape in shapes]) ** (exponent - 1.0)
    return tuple(zip(shapes, (sizes / sizes.sum()).tolist(), strict=True))


def _sized(
    spectrum: NoiseLevels, each: Sequence[Sized]
) -> tuple[float, tuple[float, NoiseColour] | None]:
    """Chi-square of white noise and processes together, and that noise; None: it is white."""
    levels = np.sum([share * shape.levels for shape, share in each], axis=0)
    cost, (white, size) = spectrum.fitted(np.column_stack([spectrum.white, levels]))
    if size <= 0.0:
        return cost, None
    variance = float(white) + sum(float(size) * share * shape.variance_ratio for shape, share in each)
    found = tuple(
        ColouredPart(
            share=float(size) * share * shape.part.share / variance,
            correlation_time_s=shape.part.correlation_time_s,
        )
        for shape, share in reversed(each)
    )
    return cost, (float(np.sqrt(variance)), NoiseColour(parts=found, flicker=len(found) > 1))

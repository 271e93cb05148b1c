"""Flicker noise: noise whose spectral density is as 1 / f, as amplifiers and strain gauges have it.

Processes whose correlation times are even on a logarithmic scale, each of the same variance, have a
density as 1 / f between 1 / (2 pi) of the longest and of the shortest of these times; here those are
that of a wave as long as a trial and the step of the samples. Its size beside white noise is fitted to
the spectrum above the frequencies of effects, as that of any noise is (`levels`); below them it is
extrapolated and never taken from the data. That asks for more trust than a process that is forgotten
in tenths of a second: most of what flicker noise does to a slow residual is not seen where it is
fitted. So it is allowed for only where nothing else explains a log.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import COLOUR_CHI_SQUARE, COLOUR_LEAST_SHARE
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour
from diagnosis.prepare.noise.spectrum.levels import NoiseShape, process, processes, spectrum_of

Array = NDArray[np.float64]

_TIMES = 8  # correlation times: the density is within some per cent of 1 / f


def flicker_noise(
    parts: Sequence[tuple[Array, Array]], means_of: int = 1
) -> tuple[float, NoiseColour] | None:
    """Standard deviation and colour of flicker noise beside white noise; None: it is not like that.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
      means_of: number of readings that a sample is the mean of.
    """
    spectrum = spectrum_of(parts)
    if spectrum is None:
        return None
    white = spectrum.white
    slowest_s = max(time_s[-1] - time_s[0] for time_s, _ in parts) / (2.0 * np.pi)
    times_s = np.geomspace(spectrum.step_s, slowest_s, _TIMES)
    shapes = [process(spectrum, float(time_s), means_of) for time_s in times_s]
    levels = np.mean([shape.levels for shape in shapes], axis=0)
    cost, (rest, size) = spectrum.fitted(np.column_stack([white, levels]))
    alone, _ = spectrum.fitted(white[:, None])
    others = (np.column_stack([white, own.levels]) for own in processes(spectrum, means_of))
    least = min(spectrum.fitted(columns)[0] for columns in others)
    if alone - cost < COLOUR_CHI_SQUARE or cost - least > COLOUR_CHI_SQUARE:
        return None
    return _of_sizes(float(rest), float(size) / _TIMES, shapes)


def _of_sizes(
    white: float, each: float, shapes: Sequence[NoiseShape]
) -> tuple[float, NoiseColour] | None:
    """White noise of a variance beside processes of one; None: its share is small."""
    sizes = [each * shape.variance_ratio for shape in shapes]
    variance = white + sum(sizes)
    found = tuple(
        ColouredPart(
            share=each * shape.part.share / variance,
            correlation_time_s=shape.part.correlation_time_s,
        )
        for shape in reversed(shapes)
    )
    if sum(sizes) < COLOUR_LEAST_SHARE * variance:
        return None
    return float(np.sqrt(variance)), NoiseColour(parts=found, flicker=True)

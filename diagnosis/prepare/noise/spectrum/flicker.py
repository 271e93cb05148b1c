"""Flicker noise: noise whose spectral density is as 1 / f, as amplifiers and strain gauges have it.

Processes whose correlation times are even on a logarithmic scale, each of the same variance, have a
density as 1 / f between 1 / (2 pi) of the longest and of the shortest of these times; here those are
that of a wave as long as a trial and the step of the samples. Its size beside white noise is fitted to
the spectrum above a frequency (`levels`); below, it is extrapolated and never taken from the data. Where
that is the frequency above which effects leave little, noise has to be coloured there for most of it to
be seen; of an amplifier whose flicker begins at 1 Hz nothing is. So the spectrum is also looked at from
`FLICKER_ABOVE_HZ` on. There slow residuals of effects may pass for noise: what that asks for besides is
in `selection/stages/sensors/coloured_noise.py`.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import COLOUR_ABOVE_HZ, COLOUR_WINDOW_S
from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour
from diagnosis.prepare.noise.spectrum.levels import NoiseShape, process, processes, spectrum_of

Array = NDArray[np.float64]

_WAVES = COLOUR_WINDOW_S * COLOUR_ABOVE_HZ
_TIMES = 8  # correlation times: the density is within some per cent of 1 / f


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
    """Flicker noise in residuals; None: there is none, or they are too short.

    Args:
      parts: time, s, and residual of each trial, (N,) each; NaN where nothing was read.
      means_of: number of readings that a sample is the mean of.
      above_hz: frequency above which the spectrum is looked at, in windows of three waves of it.
    """
    spectrum = spectrum_of(parts, above_hz, _WAVES / above_hz)
    if spectrum is None:
        return None
    white = spectrum.white
    slowest_s = max(time_s[-1] - time_s[0] for time_s, _ in parts) / (2.0 * np.pi)
    times_s = np.geomspace(spectrum.step_s, slowest_s, _TIMES)
    shapes = [process(spectrum, float(time_s), means_of) for time_s in times_s]
    levels = np.mean([shape.levels for shape in shapes], axis=0)
    cost, (rest, size) = spectrum.fitted(np.column_stack([white, levels]))
    if size <= 0.0:
        return None
    alone, _ = spectrum.fitted(white[:, None])
    others = (np.column_stack([white, own.levels]) for own in processes(spectrum, means_of))
    least = min(spectrum.fitted(columns)[0] for columns in others)
    noise = _of_sizes(float(rest), float(size) / _TIMES, shapes)
    return Flicker(gain_cost=alone - cost, behind_cost=cost - least, noise=noise)


def _of_sizes(white: float, each: float, shapes: Sequence[NoiseShape]) -> tuple[float, NoiseColour]:
    """White noise of a variance beside processes of one."""
    variance = white + sum(each * shape.variance_ratio for shape in shapes)
    found = tuple(
        ColouredPart(
            share=each * shape.part.share / variance,
            correlation_time_s=shape.part.correlation_time_s,
        )
        for shape in reversed(shapes)
    )
    return float(np.sqrt(variance)), NoiseColour(parts=found, flicker=True)

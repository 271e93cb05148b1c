"""Power spectral density of a residual, by Welch's method, beside that of white noise.

One-sided, in sigma^2 / Hz: its integral over frequency is the mean square. White noise of one sigma
has 2 x step at every frequency. Samples that were not read count as 0, and the density is raised by
their share; bands of a third of an octave are averaged.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import welch

Array = NDArray[np.float64]

_SEGMENT_S, _SEGMENT_SAMPLES = 10.0, 128
_PER_OCTAVE = 3


@dataclass(frozen=True, kw_only=True)
class Spectrum:
    """Power of a residual over frequency.

    Attributes:
      white_per_hz: density of white noise of one sigma, sigma^2 / Hz.
      power_per_hz: middle of a third of an octave in Hz, and the density there in sigma^2 / Hz.
    """

    white_per_hz: float
    power_per_hz: list[tuple[float, float]]


def spectrum(parts: Sequence[Array], step_s: float) -> Spectrum | None:
    """Spectrum of a residual at even steps, one array per trial; NaN where nothing was read.

    Returns:
      None if the trials have only a few samples.
    """
    longest = max(part.size for part in parts)
    size = min(max(round(_SEGMENT_S / step_s), _SEGMENT_SAMPLES), longest)
    if size <= 2:
        return None
    own = [_density(part, size, step_s) for part in parts]
    weights = [np.isfinite(part).sum() for part in parts]
    hertz, density = own[0][0], np.average([d for _, d in own], axis=0, weights=weights)
    return Spectrum(white_per_hz=2 * step_s, power_per_hz=_thirds(hertz[1:], density[1:]))


def _density(part: Array, size: int, step_s: float) -> tuple[Array, Array]:
    """Frequencies, and the density there; a trial shorter than a segment is one that was half read."""
    read = np.isfinite(part)
    whole = np.pad(np.where(read, part, 0.0), (0, max(0, size - part.size)))
    hertz, density = welch(whole, fs=1 / step_s, nperseg=size, detrend=False)
    return hertz, density * whole.size / max(read.sum(), 1)


def _thirds(hertz: Array, density: Array) -> list[tuple[float, float]]:
    """Means in thirds of an octave, the first around the first frequency."""
    band = np.rint(_PER_OCTAVE * np.log2(hertz / hertz[0])).astype(int)
    return [
        (float(np.exp(np.log(hertz[band == b]).mean())), float(density[band == b].mean()))
        for b in np.unique(band)
    ]

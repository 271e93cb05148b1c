"""Periodograms of windows of a residual, without what is slow, where readings may be missing.

A parabola is subtracted from each window; a missing sample counts as zero. Of noise, a periodogram
scatters as chi-square with two degrees of freedom about the spectral density, so that a low quantile of
those of many windows tells the density, whatever bursts some windows hold.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.noise import COLOUR_WINDOW_S
from diagnosis.prepare.noise.autoregression import steps_of

Array = NDArray[np.float64]

QUANTILE = 0.3
MEAN = -np.log(1 - QUANTILE)
"""The quantile that is used, and what it is of the mean of an exponential distribution."""
_FEWEST = 0.5  # share of its samples that a window has to have


def step_of(parts: Sequence[tuple[Array, Array]]) -> float:
    """Median step of the samples of all trials, s; NaN: there are none."""
    steps = np.concatenate([np.diff(time) for time, _ in parts]) if parts else np.zeros(0)
    return float(np.median(steps)) if steps.size else float("nan")


def steps_of_trials(parts: Sequence[tuple[Array, Array]]) -> list[float]:
    """The median step of all samples, s, then those of trials that were sampled more slowly."""
    first = step_of(parts)
    slower = {step_of([part]) for part in parts if step_of([part]) > first}
    return [first, *sorted(slower)] if np.isfinite(first) else []


def windows_of(
    evens: Sequence[Array],
    step_s: float,
    filled: Sequence[Array] | None = None,
    window_s: float = COLOUR_WINDOW_S,
) -> list[Array]:
    """Windows with half overlap that have enough samples, (N,) each; NaN where none was read.

    Args:
      evens: values at even steps by trial.
      filled: the same with something else where none was read, to be cut into the same windows.
      window_s: of each.
    """
    size = round(window_s / step_s)
    found = []
    for values, shown in zip(evens, filled or evens, strict=True):
        starts = range(0, values.size - size + 1, max(size // 2, 1))
        found += [
            shown[i : i + size] for i in starts if np.isfinite(values[i : i + size]).mean() >= _FEWEST
        ]
    return found


def taper_of(size: int) -> Array:
    """A Hann window, (N,)."""
    return np.asarray(np.hanning(size + 2)[1:-1])


def periodogram(values: Array, taper: Array) -> Array:
    """Periodogram of one window without its parabola, per sample that was read."""
    known, weights, scale = trend(values, taper)
    there = np.nan_to_num(values)
    left = (there - known @ (np.linalg.pinv(known) @ there)) * weights
    return np.asarray(np.abs(np.fft.rfft(left)) ** 2 / scale)


def trend(values: Array, taper: Array) -> tuple[Array, Array, float]:
    """Parabolas where a window was read and 0 elsewhere, (N, 3), its taper likewise, and its squares."""
    read = np.isfinite(values)
    parabolas = np.vander(np.linspace(-1, 1, values.size), 3) * read[:, None]
    weights = taper * read
    return parabolas, weights, float(np.sum(weights**2))


def even(time_s: Array, values: Array, step_s: float) -> Array:
    """Values at even steps, each at the nearest; NaN where none was read."""
    place = steps_of(time_s, step_s)
    level = np.full(place[-1] + 1, np.nan)
    read = np.isfinite(values)
    level[place[read]] = values[read]
    return level

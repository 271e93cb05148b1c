"""A line in a spectrum: a steady oscillation in readings, at any times, tapered by a Hann window.

    readings = signal + a cos(2 pi f t) + b sin(2 pi f t) + noise

The signal is slow: less its means over 0.1 s, also across gaps, it leaves next to nothing at a fast
frequency. Cosine and sine are fitted by least squares (Lomb and Scargle), since at half the sampling
rate there is no sine.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lombscargle

Array = NDArray[np.float64]

_MEANS_S, _MEANS_OF = 0.1, 8  # samples at least
_DEGENERATE = 1e-4  # share of the normal equations of a line at half the sampling rate: sines are 0
# Frequencies beside a line that are compared with it, in 1 / T; those between them tell little more.
_BESIDE = (4, 41, 2)


def power_over_neighbours(time_s: Array, values: Array, tried_hz: Array) -> Array:
    """Power of readings at each frequency / the mean power beside all of them, (F,).

    Args:
      time_s, values: of the readings, (N,) each.
      tried_hz: increasing, (F,).
    """
    apart = np.arange(*_BESIDE) / float(time_s[-1] - time_s[0])
    fast, weights = _fast(time_s, values), _taper(time_s)
    found, below, above = (
        lombscargle(time_s, fast, 2 * np.pi * own, weights=weights)
        for own in (tried_hz, tried_hz[0] - apart, tried_hz[-1] + apart)
    )
    level = float(np.mean([below, above]))
    return np.asarray(found / level) if level > 0 else np.zeros(tried_hz.size)


def line_in(time_s: Array, values: Array, frequency_hz: float) -> Array:
    """The line of a frequency in readings, (N,): their least-squares cosine and sine."""
    root, line = np.sqrt(_taper(time_s)), _line(time_s, frequency_hz)
    fast = np.column_stack([_fast(time_s, own) for own in (*line.T, values)]) * root[:, None]
    found, *_ = np.linalg.lstsq(fast[:, :2], fast[:, 2], rcond=np.sqrt(_DEGENERATE))
    return np.asarray(line @ found)


def _fast(time_s: Array, values: Array) -> Array:
    """Values less lines through their means over some periods: it jumps in no gap, (N,)."""
    width_s = max(_MEANS_S, _MEANS_OF * float(np.median(np.diff(time_s))))
    block = np.unique(np.floor((time_s - time_s[0]) / width_s), return_inverse=True)[1]
    count = np.bincount(block)
    middle, means = (np.bincount(block, weights=own) / count for own in (time_s, values))
    return np.asarray(values - np.interp(time_s, middle, means))


def _taper(time_s: Array) -> Array:
    """Hann weights over a part, whose sum is 1, (N,)."""
    since = (time_s - time_s[0]) / (time_s[-1] - time_s[0])
    weights = np.sin(np.pi * since) ** 2
    return np.asarray(weights / weights.sum())


def _line(time_s: Array, frequency_hz: float) -> Array:
    """Cosine and sine of a line, (N, 2)."""
    phase = 2 * np.pi * frequency_hz * time_s
    return np.column_stack([np.cos(phase), np.sin(phase)])

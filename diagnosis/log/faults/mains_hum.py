"""Hum: a line at the mains frequency in the readings of a sensor.

The mains of 50 or 60 Hz, and its harmonics, reach cables and amplifiers. Its frequency is that of the
grid, off by a few hundredths of 1 Hz, and its amplitude and phase are steady:

    reading = signal + a cos(2 pi f t) + b sin(2 pi f t) + noise

A needle does nothing of the kind: what it does lasts for a motion. Over a whole trial of duration T,
tapered, a line is sharper than 4 / T, and motions, less their means over 0.1 s, leave next to nothing at
its frequency. So a line is
what stands out of the spectrum beside it, in all trials together. For noise the power at a frequency /
the mean power beside it has an exponential distribution, and its sum over K trials that of a gamma
distribution. The line of each trial is then subtracted, which costs it two degrees of freedom.

A line that the sampling folds to a low frequency is left: there it is a drift, or part of a motion. So
is one that the base shows, too: it may turn.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import gamma

from diagnosis.criteria import (
    FEWEST_ROWS,
    HUM_FALSE_ALARMS,
    HUM_GRID_HZ,
    HUM_HARMONICS,
    HUM_LOWEST_HZ,
    HUM_MAINS_HZ,
)
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_BASE = "base_angle_deg"
_FINER = 4  # frequencies that are looked at per 1 / T
_MEANS_S = 0.1
_DEGENERATE = 1e-4  # share of the normal equations of a line at half the sampling rate: sines are 0
_BESIDE = (4, 40)  # frequencies beside a line that are compared with it, in 1 / T


def without_hum(trials: Sequence[Trial], noise: Mapping[str, float]) -> tuple[list[Trial], list[str]]:
    """The trials without hum in the readings of sensors, and a warning for each line."""
    changed, warnings = list(trials), []
    mains = [own * times for own in HUM_MAINS_HZ for times in range(1, HUM_HARMONICS + 1)]
    for sensor, about_hz in ((s, own) for s in SENSORS for own in mains if s in noise):
        found_hz = _line_hz(changed, sensor, about_hz)
        if found_hz is None or _line_hz(changed, _BASE, about_hz) is not None:
            continue
        found = [_subtracted(trial, sensor, found_hz) for trial in changed]
        changed = [trial for trial, _ in found]
        warnings.append(_told(sensor, found_hz, [size for _, size in found if size > 0]))
    return changed, warnings


def _line_hz(trials: Sequence[Trial], column: str, about_hz: float) -> float | None:
    """Frequency of the strongest line near one; None: it is no stronger than noise makes one."""
    read = [(t, y) for t, y in (_read(trial, column) for trial in trials) if _shows(t, about_hz)]
    if not read:
        return None
    step_hz = 1.0 / (_FINER * max(float(t[-1] - t[0]) for t, _ in read))
    side = np.arange(1, int(np.ceil(HUM_GRID_HZ / step_hz)) + 1) * step_hz
    tried = about_hz + np.concatenate([-side[::-1], [0.0], side])
    power = _power(read, tried)
    if power.max() <= gamma.isf(HUM_FALSE_ALARMS / tried.size, len(read)):
        return None
    near = tried[np.argmax(power)] + step_hz * np.linspace(-0.5, 0.5, 2 * _FINER + 1)
    return float(near[np.argmax(_power(read, near))])


def _power(read: Sequence[tuple[Array, Array]], tried_hz: Array) -> Array:
    """Power at each frequency / the mean power beside all of them, added up over trials, (F,)."""
    return np.asarray(np.sum([_above_its_neighbours(t, y, tried_hz) for t, y in read], axis=0))


def _read(trial: Trial, column: str) -> tuple[Array, Array]:
    """Times, s, and readings of a column, (N,) each."""
    if not trial.has(column):
        return np.zeros(0), np.zeros(0)
    finite = np.isfinite(trial[column])
    return trial["time_s"][finite], trial[column][finite]


def _shows(time_s: Array, frequency_hz: float) -> bool:
    """Whether readings at these times show a line, at a frequency that is fast."""
    if time_s.size < FEWEST_ROWS:
        return False
    rate_hz = 1.0 / float(np.median(np.diff(time_s)))
    return abs(frequency_hz - rate_hz * round(frequency_hz / rate_hz)) > HUM_LOWEST_HZ


def _above_its_neighbours(time_s: Array, values: Array, tried_hz: Array) -> Array:
    apart = np.arange(*_BESIDE) / float(time_s[-1] - time_s[0])
    weights = _taper(time_s)
    tapered = weights * _fast(time_s, values)
    found, below, above = (
        _taken_off(time_s, tapered, weights, own)
        for own in (tried_hz, tried_hz[0] - apart, tried_hz[-1] + apart)
    )
    return np.asarray(found / np.mean([below, above]))


def _taken_off(time_s: Array, tapered: Array, weights: Array, frequencies_hz: Array) -> Array:
    """What the least-squares line of each frequency takes off the mean square of readings, (F,).

    Args:
      frequencies_hz: evenly spaced, (F,).
    """
    step_hz = float(frequencies_hz[1] - frequencies_hz[0])
    turned = np.exp(2j * np.pi * frequencies_hz[0] * time_s)
    step = np.exp(2j * np.pi * step_hz * time_s)
    read, twice = np.zeros((2, frequencies_hz.size), complex)
    for at in range(frequencies_hz.size):
        read[at], twice[at] = turned @ tapered, turned**2 @ weights
        turned *= step
    right = np.stack([read.real, read.imag], axis=-1)
    normal = 0.5 * np.stack([1 + twice.real, twice.imag, twice.imag, 1 - twice.real], axis=-1)
    inverse = np.linalg.pinv(normal.reshape(-1, 2, 2), rcond=_DEGENERATE, hermitian=True)
    return np.asarray(np.einsum("fi,fij,fj->f", right, inverse, right))


def _fast(time_s: Array, values: Array) -> Array:
    """Values less lines through their means over five periods: it jumps in no gap, (N,)."""
    block = np.unique(np.floor((time_s - time_s[0]) / _MEANS_S), return_inverse=True)[1]
    count = np.bincount(block)
    middle, means = (np.bincount(block, weights=own) / count for own in (time_s, values))
    return np.asarray(values - np.interp(time_s, middle, means))


def _taper(time_s: Array) -> Array:
    """Hann weights over a trial, whose sum is 1, (N,)."""
    since = (time_s - time_s[0]) / (time_s[-1] - time_s[0])
    weights = np.sin(np.pi * since) ** 2
    return np.asarray(weights / weights.sum())


def _subtracted(trial: Trial, sensor: str, frequency_hz: float) -> tuple[Trial, float]:
    """The trial without a line, and its amplitude; 0 where it has none."""
    time_s, values = _read(trial, sensor)
    if not _shows(time_s, frequency_hz):
        return trial, 0.0
    root, line = np.sqrt(_taper(time_s)), _line(time_s, frequency_hz)
    fast = np.column_stack([_fast(time_s, own) for own in (*line.T, values)]) * root[:, None]
    found, *_ = np.linalg.lstsq(fast[:, :2], fast[:, 2], rcond=np.sqrt(_DEGENERATE))
    rest = trial[sensor] - _line(trial["time_s"], frequency_hz) @ found
    size = float(np.sqrt(2 * np.mean((line @ found) ** 2)))
    return replace(trial, table=trial.table.assign(**{sensor: rest})), size


def _line(time_s: Array, frequency_hz: float) -> Array:
    """Cosine and sine of a line, (N, 2)."""
    phase = 2 * np.pi * frequency_hz * time_s
    return np.column_stack([np.cos(phase), np.sin(phase)])


def _told(sensor: str, line_hz: float, sizes: Sequence[float]) -> str:
    return (
        f"{sensor} hums at {line_hz:.2f} Hz, as the mains do, by {float(np.median(sizes)):.2g}: this is "
        "subtracted; shield the cable of the sensor"
    )

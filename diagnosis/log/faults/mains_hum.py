"""Hum: a line at the mains frequency in the readings of a sensor.

The mains of 50 or 60 Hz, and its harmonics, reach cables and amplifiers. Its frequency is that of the
grid, off by a few hundredths of 1 Hz, and its amplitude and phase are steady:

    reading = signal + a cos(2 pi f t) + b sin(2 pi f t) + noise

A needle does nothing of the kind: what it does lasts for a motion. Over a part of a trial of duration T,
tapered, a line is sharper than 4 / T, and motions, less their means over 0.1 s, leave next to nothing at
its frequency. So a line is
what stands out of the spectrum beside it, in all parts together. For noise the power at a frequency /
the mean power beside it has an exponential distribution, and its sum over K parts that of a gamma
distribution. The line of each part is then subtracted, which costs it two degrees of freedom. Parts
end where nothing was read for a while, and before the grid's frequency wanders.

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
_MEANS_S, _MEANS_OF = 0.1, 8  # samples at least
_PART_S, _PAUSE_S = 120.0, 2.0
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
        warnings.append(_told(sensor, found_hz, [size for _, sizes in found for size in sizes]))
    return changed, warnings


def _line_hz(trials: Sequence[Trial], column: str, about_hz: float) -> float | None:
    """Frequency of the strongest line near one; None: it is no stronger than noise makes one."""
    rows = [(trial, own) for trial in trials for own in _parts(trial, column, about_hz)]
    read = [(trial["time_s"][own], trial[column][own]) for trial, own in rows]
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
    """Power at each frequency / the mean power beside all of them, added up over parts, (F,)."""
    return np.asarray(np.sum([_above_its_neighbours(t, y, tried_hz) for t, y in read], axis=0))


def _parts(trial: Trial, column: str, frequency_hz: float) -> list[NDArray[np.intp]]:
    """Rows of the parts of a trial whose readings may show a line, at a frequency that is fast."""
    if not trial.has(column):
        return []
    read = np.flatnonzero(np.isfinite(trial[column]))
    time_s = trial["time_s"][read]
    number = np.cumsum(np.diff(time_s, prepend=time_s[0]) > _PAUSE_S)
    count = np.floor((time_s - time_s[0]) / _PART_S)
    ends = np.flatnonzero((np.diff(number) != 0) | (np.diff(count) != 0)) + 1
    return [own for own in np.split(read, ends) if _shows(trial["time_s"][own], frequency_hz)]


def _shows(time_s: Array, frequency_hz: float) -> bool:
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
    level = float(np.mean([below, above]))
    return np.asarray(found / level) if level > 0 else np.zeros(tried_hz.size)


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


def _subtracted(trial: Trial, sensor: str, frequency_hz: float) -> tuple[Trial, list[float]]:
    """The trial without a line, and its amplitude in each part."""
    rest, sizes = trial[sensor].copy(), list[float]()
    for rows in _parts(trial, sensor, frequency_hz):
        found = _fitted(trial["time_s"][rows], rest[rows], frequency_hz)
        rest[rows] -= found
        sizes.append(float(np.sqrt(2 * np.mean(found**2))))
    return replace(trial, table=trial.table.assign(**{sensor: rest})), sizes


def _fitted(time_s: Array, values: Array, frequency_hz: float) -> Array:
    """The line in readings, (N,)."""
    root, line = np.sqrt(_taper(time_s)), _line(time_s, frequency_hz)
    fast = np.column_stack([_fast(time_s, own) for own in (*line.T, values)]) * root[:, None]
    found, *_ = np.linalg.lstsq(fast[:, :2], fast[:, 2], rcond=np.sqrt(_DEGENERATE))
    return np.asarray(line @ found)


def _line(time_s: Array, frequency_hz: float) -> Array:
    """Cosine and sine of a line, (N, 2)."""
    phase = 2 * np.pi * frequency_hz * time_s
    return np.column_stack([np.cos(phase), np.sin(phase)])


def _told(sensor: str, line_hz: float, sizes: Sequence[float]) -> str:
    return (
        f"{sensor} hums at {line_hz:.2f} Hz, as the mains do, by {float(np.median(sizes)):.2g}: this is "
        "subtracted; shield the cable of the sensor"
    )

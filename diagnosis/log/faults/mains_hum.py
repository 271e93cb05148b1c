"""Hum: a line at the mains frequency in the readings of a sensor.

The mains of 50 or 60 Hz, and its harmonics, reach cables and amplifiers. Its frequency is that of the
grid, off by a few hundredths of 1 Hz which differ from trial to trial; in one, it is steady:

    reading = signal + a cos(2 pi f t) + b sin(2 pi f t) + noise

A needle does nothing of the kind: what it does lasts for a motion. Over a part of a trial of duration T,
tapered, a line is sharper than 4 / T, and motions leave next to nothing at its frequency
(`spectral_line`). So a line is what stands out of the spectrum beside it, in all parts together. For
noise the power at a frequency / the mean power beside it has an exponential distribution, and its sum
over K parts that of a gamma distribution. The line of each part is then subtracted at its own
frequency, which costs it three degrees of freedom. Parts end where nothing was read for a while, and
before the grid wanders.

A line that the sampling folds to a low frequency is left: there it is a drift, or part of a motion. So
is one that the base shows, too: it may turn.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.stats import gamma

from diagnosis.criteria.faults import (
    HUM_FALSE_ALARMS,
    HUM_GRID_HZ,
    HUM_HARMONICS,
    HUM_LOWEST_HZ,
    HUM_MAINS_HZ,
    HUM_WANDERS_HZ,
)
from diagnosis.criteria.log import FEWEST_ROWS
from diagnosis.log.faults.spectral_line import line_in, power_over_neighbours
from diagnosis.log.trial import SENSORS, Trial

Array = NDArray[np.float64]

_BASE = "base_angle_deg"
_FINER = 2  # frequencies that are looked at per 1 / T: between two, a line has lost a tenth at most
_NEAR = 16  # times as fine about a line that was found
_PART_S, _PAUSE_S = 40.0, 2.0


def without_hum(trials: Sequence[Trial], noise: Mapping[str, float]) -> tuple[list[Trial], list[str]]:
    """The trials without hum in the readings of sensors, and a warning for each line."""
    changed, warnings = list(trials), []
    lines_hz = _apart(trials)
    for sensor, about_hz in ((s, own) for s in SENSORS for own in lines_hz if s in noise):
        found_hz = _line_hz(changed, sensor, about_hz)
        if found_hz is None or _line_hz(changed, _BASE, about_hz) is not None:
            continue
        found = [_subtracted(trial, sensor, found_hz) for trial in changed]
        changed = [trial for trial, _ in found]
        warnings.append(_told(sensor, [line for _, lines in found for line in lines]))
    return changed, warnings


def _apart(trials: Sequence[Trial]) -> list[float]:
    """The lines, without those that sampling folds to where another one is in every trial."""
    rates_hz = [_rate_hz(trial["time_s"]) for trial in trials]
    found: dict[tuple[float, ...], float] = {}
    for line_hz in (own * times for own in HUM_MAINS_HZ for times in range(1, HUM_HARMONICS + 1)):
        folded = tuple(round(_folded_hz(line_hz, rate_hz), 2) for rate_hz in rates_hz)
        found.setdefault(folded, line_hz)
    return list(found.values())


def _rate_hz(time_s: Array) -> float:
    return 1.0 / float(np.median(np.diff(time_s)))


def _folded_hz(line_hz: float, rate_hz: float) -> float:
    """Frequency at which samples show a line."""
    return abs(line_hz - rate_hz * round(line_hz / rate_hz))


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
    near = tried[np.argmax(power)] + step_hz * np.linspace(-0.5, 0.5, _NEAR + 1)
    return float(near[np.argmax(_power(read, near))])


def _power(read: Sequence[tuple[Array, Array]], tried_hz: Array) -> Array:
    """Power at each frequency / the mean power beside all of them, added up over parts, (F,)."""
    return np.asarray(np.sum([power_over_neighbours(t, y, tried_hz) for t, y in read], axis=0))


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
    return time_s.size >= FEWEST_ROWS and _folded_hz(frequency_hz, _rate_hz(time_s)) > HUM_LOWEST_HZ


@dataclass(frozen=True, kw_only=True)
class _Line:
    """Frequency of a line in one part of a trial, and its amplitude in the unit of the sensor."""

    frequency_hz: float
    size: float


def _subtracted(trial: Trial, sensor: str, about_hz: float) -> tuple[Trial, list[_Line]]:
    """The trial without the line near a frequency, and that line in each part."""
    rest, lines = trial[sensor].copy(), list[_Line]()
    for rows in _parts(trial, sensor, about_hz):
        time_s, read = trial["time_s"][rows], rest[rows]
        own_hz = _own_hz(time_s, read, about_hz)
        line = line_in(time_s, read, own_hz)
        rest[rows] -= line
        lines.append(_Line(frequency_hz=own_hz, size=float(np.sqrt(2 * np.mean(line**2)))))
    return replace(trial, table=trial.table.assign(**{sensor: rest})), lines


def _own_hz(time_s: Array, read: Array, about_hz: float) -> float:
    """Frequency of the line in a part: the grid's when that was recorded."""
    step_hz = 1.0 / (_FINER * _NEAR * float(time_s[-1] - time_s[0]))
    most = int(np.ceil(HUM_WANDERS_HZ / step_hz))
    tried = about_hz + step_hz * np.arange(-most, most + 1, dtype=np.float64)
    return float(tried[np.argmax(power_over_neighbours(time_s, read, tried))])


def _told(sensor: str, lines: Sequence[_Line]) -> str:
    about_hz = float(np.median([line.frequency_hz for line in lines]))
    size = float(np.median([line.size for line in lines]))
    return (
        f"{sensor} hums at {about_hz:.2f} Hz, as the mains do, by {size:.2g}: this is subtracted; "
        "shield the cable of the sensor"
    )

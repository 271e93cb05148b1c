"""Sensors that are read less often than rows are written: a camera or tracker beside a fast drive.

A logger fills the rows between two readings in one of two ways: it repeats the last one, maybe under
noise of its own (`held_readings`), or it draws a straight line to the next. What it writes there is no
reading. Repeated values look like a sensor that is
late by half its period, lines like one that rounds corners, and both like noise that is correlated.
So only rows with a new reading count.

The scatter of a working sensor tells. For white noise of standard deviation s, read in steps of q,
the probability that

    one reading equals the last, of at most                        erf(q / (2 sqrt(2) s))
    it is within q of the line through its neighbours, of at most  erf(q / (sqrt(2) sqrt(1.5) s))

If that happens several times as often, and regularly, the rows between are filled.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from diagnosis.criteria.faults import (
    BELIEVED_SCATTER,
    SLOW_LEAST_SHARE,
    SLOW_REGULAR_SHARE,
    SLOW_TIMES_CHANCE,
)
from diagnosis.criteria.log import FEWEST_ROWS
from diagnosis.log.checks.wording import listed
from diagnosis.log.faults.scatter import quantum
from diagnosis.log.times.held_readings import held_rows
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]
_Filled = Callable[[Array, Array, float], Mask]
Filled = Callable[[Sequence[Trial], str, float], list[Mask]]

_BASE = "base_angle_deg"
_LINE_STEPS = math.sqrt(1.5)  # noise of a reading less the mean of its neighbours, in that of one


def with_new_readings(
    trials: Sequence[Trial], noise: Mapping[str, float]
) -> tuple[list[Trial], list[str]]:
    """The trials with the readings of slow sensors where they are new, and a warning for each sensor.

    What a logger filled in becomes NaN. The base drives the needle and cannot be missing: what
    was repeated is replaced by a smooth curve through its new readings.

    Args:
      noise: claimed standard deviation by column.
    """
    changed, warnings = list(trials), []
    for column, filled, how in _HABITS:
        rows = filled(changed, column, noise.get(column, 0.0))
        if any(old.any() for old in rows):
            warnings.append(_told(column, how, rows, changed))
            changed = [_without(trial, column, old) for trial, old in zip(changed, rows, strict=True)]
    return changed, warnings


def _each(filled: _Filled) -> Filled:
    """The rows of each trial that were filled in one way."""
    return lambda trials, column, claim: [_filled(one, column, claim, filled) for one in trials]


def _filled(trial: Trial, column: str, claim: float, filled: _Filled) -> Mask:
    """Mask of the rows that were filled in, (N,); of none if chance may have made them."""
    none = np.zeros(trial["time_s"].size, bool)
    values = trial[column] if trial.has(column) else np.full(none.size, np.nan)
    read = np.isfinite(values)
    if np.count_nonzero(read) < FEWEST_ROWS or not claim > 0:
        return none
    step = quantum(values)
    rows = filled(trial["time_s"], values, step)
    found = white_noise([values[read & ~rows]], order=2)
    if not found >= BELIEVED_SCATTER * claim:
        return none
    width = 2.0 if filled is _repeated else _LINE_STEPS
    chance = math.erf(step / (math.sqrt(2) * width * min(claim, found)))
    share = np.count_nonzero(rows) / np.count_nonzero(read)
    often = share > max(SLOW_LEAST_SHARE, SLOW_TIMES_CHANCE * chance)
    return rows if often and _regular(rows[read]) else none


def _regular(rows: Mask) -> bool:
    """Whether most filled rows are between readings as far apart as usual, give or take one row."""
    apart = np.diff(np.flatnonzero(~rows))
    usual = np.abs(apart - np.median(apart)) <= 1
    return bool((apart[usual] - 1).sum() > SLOW_REGULAR_SHARE * (apart - 1).sum())


def _repeated(_time_s: Array, values: Array, _step: float) -> Mask:
    """Rows that repeat the reading before, (N,)."""
    read = np.flatnonzero(np.isfinite(values))
    rows = np.zeros(values.size, bool)
    rows[read[1:]] = np.diff(values[read]) == 0
    return rows


def _on_a_line(time_s: Array, values: Array, step: float) -> Mask:
    """Rows on the line between their neighbours; of two beside a corner, that farther from it, (N,)."""
    read = np.flatnonzero(np.isfinite(values))
    rows = np.zeros(values.size, bool)
    if read.size < FEWEST_ROWS:
        return rows
    at, own = time_s[read], values[read]
    share = (at[1:-1] - at[:-2]) / (at[2:] - at[:-2])
    off = np.abs(own[1:-1] - (1 - share) * own[:-2] - share * own[2:])
    corner = off > step * (1 + 1e-6)
    edges = np.flatnonzero(np.diff(np.concatenate(([0], corner.astype(np.int8), [0]))))
    for first, end in edges.reshape(-1, 2)[np.diff(edges.reshape(-1, 2)).ravel() == 2].tolist():
        corner[first + int(np.argmin(off[first:end]))] = False
    rows[read[1:-1]] = ~corner
    rows[read[[0, -1]]] = True
    return rows


def _without(trial: Trial, column: str, old: Mask) -> Trial:
    """The trial without the readings that were filled in."""
    values = trial[column]
    if column in SENSORS:
        return replace(trial, table=trial.table.assign(**{column: np.where(old, np.nan, values)}))
    time_s, new = trial["time_s"], ~old
    curve = PchipInterpolator(time_s[new], values[new])(np.clip(time_s, None, time_s[new][-1]))
    return replace(trial, table=trial.table.assign(**{column: np.where(old, curve, values)}))


_HABITS: tuple[tuple[str, Filled, str], ...] = (
    (_BASE, _each(_repeated), "repeats its last reading"),
    *((sensor, _each(_repeated), "repeats its last reading") for sensor in SENSORS),
    *((sensor, _each(_on_a_line), "is interpolated") for sensor in SENSORS),
    *((sensor, held_rows, "holds its last reading, under noise,") for sensor in SENSORS),
)


def _told(column: str, how: str, rows: Sequence[Mask], trials: Sequence[Trial]) -> str:
    slow = [(trial, old) for trial, old in zip(trials, rows, strict=True) if old.any()]
    apart = [np.diff(trial["time_s"][~old & np.isfinite(trial[column])]) for trial, old in slow]
    period_ms = 1e3 * float(np.median(np.concatenate(apart)))
    own = np.concatenate([old for _, old in slow])
    where = "" if len(slow) == len(trials) else f"{listed([trial.name for trial, _ in slow])}: "
    done = "replaced by a smooth curve" if column == _BASE else "not used"
    return (
        f"{where}{column} {how} between new ones every {period_ms:.3g} ms, in {own.sum()} of {own.size} "
        f"rows; these are {done}"
    )

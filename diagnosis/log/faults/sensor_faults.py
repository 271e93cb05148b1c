"""Invalid samples of a sensor: outliers, saturated or frozen ones.

The readings of a working sensor scatter. A repeated reading counts as frozen only if its scatter
would have changed it: for white noise of standard deviation s, read in steps of q, one
reading equals the next with a probability of at most p = erf(q / (2 sqrt(2) s)), and a run
of n with p^(n-1). If s is below q/2, repeats are normal and nothing is concluded.
"""

import math
from collections.abc import Collection, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import label

from diagnosis.criteria.checks import NOISE_RATIO
from diagnosis.criteria.faults import (
    FALSE_ALARM_CHANCE,
    FROZEN_LEAST_AGAIN,
    FROZEN_LEAST_RUN,
    FROZEN_LEAST_S,
    FROZEN_TIMES_USUAL_RUN,
    PULSES_SHARE,
)
from diagnosis.log.checks.wording import lines
from diagnosis.log.faults.outliers import AT_AN_END, Outliers, find_outliers
from diagnosis.log.faults.saturated import saturated_rows
from diagnosis.log.faults.scatter import quantum, runs_of, seen_scatter
from diagnosis.log.trial import BASE, SENSORS, Trial
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_EMPTIED = "these samples are not used"
_REPLACED = "replaced by values from their neighbours"
_KEPT = "used as it is: correct or cut these rows"


def without_faults(
    trial: Trial,
    noise: Mapping[str, float],
    ends: Mapping[str, Collection[float]] = MappingProxyType({}),
) -> tuple[Trial, list[str]]:
    """The trial without faulty readings, in memory, and a warning for each kind of fault.

    Faulty readings of a sensor become NaN. The base angle drives the needle and cannot be missing: its
    outliers are replaced by values from their neighbours, and frozen readings are kept.

    Args:
      trial: the trial as read.
      noise: claimed standard deviation by column.
      ends: of the ranges of sensors, which other trials show.
    """
    table, warnings = trial.table.copy(), []
    outliers = _outliers(trial, noise)
    for name, off in outliers.items():
        read, claim = trial[name], noise[name]
        values = np.where(off.rows, np.nan, read)
        saturated = saturated_rows(values, claim, ends.get(name, ()))
        frozen = _frozen(trial["time_s"], np.where(saturated, np.nan, values), claim)
        faults = {
            "stands at an end of its range, or next to it (saturated)": (saturated, _KEPT),
            "repeats one value where it should scatter (frozen)": (frozen, _KEPT),
            "disagrees with the samples on both sides (outliers)": (off.rows, _REPLACED),
        }
        for what, (rows, done) in faults.items():
            if rows.any():
                warnings.append(
                    _told(trial.name, name, what, rows, _EMPTIED if name in SENSORS else done)
                )
        table[name] = (
            np.where(saturated | frozen, np.nan, values)
            if name in SENSORS
            else _as_read(off.expected, values, claim)
        )
    return replace(trial, table=table), warnings


def _outliers(trial: Trial, noise: Mapping[str, float]) -> dict[str, Outliers]:
    """Outliers by column; a pulse of the base to which other signals respond is motion, no outlier.

    Nor is what the base does at either end of a trial: a motion may begin or end there.
    """
    time, having = trial["time_s"], [name for name in noise if trial.has(name)]
    found = {n: find_outliers(time, trial[n], _outlier_scale(trial[n], noise[n])) for n in having}
    found[BASE] = found[BASE].without(_from_an_end(found[BASE].rows), trial[BASE])
    base = found[BASE].rows
    answers = np.logical_or.reduce(
        [off.rows for name, off in found.items() if name != BASE] or [base & False]
    )
    pulses = base & _beside(answers)
    if not pulses.any() or pulses.sum() < PULSES_SHARE * base.sum():
        return found
    near = _beside(pulses)
    return {name: off.without(near, trial[name]) for name, off in found.items()}


def _from_an_end(rows: Mask) -> Mask:
    """The first and last samples, and those outliers that reach as far as these."""
    row = np.arange(rows.size)
    ends = (row < AT_AN_END) | (row >= rows.size - AT_AN_END)
    reached, _ = label(rows | ends)
    return np.asarray(np.isin(reached, reached[ends]))


def _beside(rows: Mask) -> Mask:
    """The rows, and one more on each side."""
    return np.asarray(np.convolve(rows, np.ones(3), "same") > 0)


def _told(file: str, column: str, what: str, rows: Mask, done: str) -> str:
    return f"{file}: {column} {what} in {rows.sum()} of {rows.size} samples, {lines(rows)}; {done}"


def _as_read(expected: Array, values: Array, claim: float) -> Array:
    """Expected values for replaced readings, in the steps of a coarse encoder."""
    step = quantum(values)
    whole = np.round((expected - values[np.isfinite(values)][0]) / step) if step > claim > 0 else None
    return (
        expected
        if whole is None
        else np.where(np.isfinite(values), values, values[np.isfinite(values)][0] + whole * step)
    )


def _outlier_scale(values: Array, claim: float) -> float:
    """White noise of readings, at least half of the claim and the noise of rounding."""
    finite = values[np.isfinite(values)]
    fresh = np.concatenate(([True], np.diff(finite) != 0))[: finite.size]
    found = white_noise([finite[fresh]], order=4)
    return float(np.nanmax([found, NOISE_RATIO[0] * claim, quantum(values) / math.sqrt(12)]))


def _frozen(time_s: Array, values: Array, claim: float) -> Mask:
    finite = np.flatnonzero(np.isfinite(values))
    starts, lengths = runs_of(values[finite])
    noise = seen_scatter(values, claim)
    rows = np.zeros(values.size, bool)
    if noise == 0 or finite.size == 0:
        return rows
    repeat = math.erf(quantum(values) / (2 * math.sqrt(2) * noise))
    chance = math.log(FALSE_ALARM_CHANCE / finite.size) / math.log(max(repeat, 1e-12))
    # A slow sensor in a fast log holds every reading for a while: that is its habit.
    usual = float(np.median(lengths)) if lengths.size > 1 else 0.0
    least = max(FROZEN_LEAST_AGAIN, chance + 1, FROZEN_TIMES_USUAL_RUN * usual)
    lasted = time_s[finite[starts + lengths - 1]] - time_s[finite[starts]]
    sure = (lengths >= max(least, FROZEN_LEAST_RUN)) & (lasted >= FROZEN_LEAST_S)
    # A sensor that freezes for long does so for shorter times as well.
    frozen = lengths >= least if sure.any() else sure
    rows[finite[np.repeat(frozen, lengths)]] = True
    return rows

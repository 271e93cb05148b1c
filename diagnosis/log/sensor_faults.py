"""Samples that a sensor cannot have meant: saturated, frozen, or a lone spike.

A working sensor scatters. A reading that repeats is frozen only where its scatter
would have moved it: with white noise of standard deviation s read in steps of q, one
reading equals the next at most by the chance p = erf(q / (2 sqrt(2) s)), and a run
of n by p^(n-1). Where s is below q/2, repeats are the rule and nothing is concluded.
"""

import math
from collections.abc import Mapping

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from diagnosis.criteria import (
    BELIEVED_SCATTER,
    FALSE_ALARM_CHANCE,
    FROZEN_LEAST_RUN,
    FROZEN_LEAST_S,
    FROZEN_TIMES_USUAL_RUN,
    SATURATED_BESIDE,
    SATURATED_LEAST_RUN,
    SATURATED_NEAR_SIGMA,
    SATURATED_SHARE,
    SPIKE_SHARE,
    SPIKE_SIGMA,
)
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.log.white_noise import white_noise

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]


def without_faults(trial: Trial, noise: Mapping[str, float]) -> tuple[Trial, list[str]]:
    """The trial with faulty readings emptied, in memory, and a warning for each kind of fault.

    The base angle drives the needle and cannot be empty: its faults are told and kept.

    Args:
      trial: as read.
      noise: claimed standard deviation by column.
    """
    table, warnings = trial.table.copy(), []
    spikes = {name: _spikes(trial[name], claim) for name, claim in noise.items() if trial.has(name)}
    for name in spikes:
        values, claim = trial[name], noise[name]
        saturated = _saturated(values, claim)
        frozen = _frozen(trial["time_s"], np.where(saturated, np.nan, values), claim)
        lone = _alone(name, spikes) & ~saturated & ~frozen
        faults = {
            "stands at an end of its range, or beside it (saturated)": saturated,
            "repeats one value where it should scatter (frozen)": frozen,
            "jumps there and back (spikes)": lone,
        }
        warnings += [_told(trial.name, name, what, rows) for what, rows in faults.items() if rows.any()]
        if name in SENSORS:
            table.loc[saturated | frozen | lone, name] = np.nan
    return Trial(name=trial.name, table=table), warnings


def scatter(values: Array) -> float:
    """Standard deviation of the white part of a reading, without its runs of equal values."""
    finite = values[np.isfinite(values)]
    starts, lengths = _runs(finite)
    moving = finite[np.repeat(lengths < FROZEN_LEAST_RUN, lengths)] if starts.size else finite
    return white_noise([moving], order=2)


def quantum(values: Array) -> float:
    """The smallest step between two different readings; 0 if there is one value alone."""
    steps = np.diff(np.unique(values[np.isfinite(values)]))
    # Decimal fractions differ by rounding alone in their last bits.
    steps = steps[steps > 1e-9 * np.nanmax(np.abs(values), initial=0.0)]
    return float(steps.min()) if steps.size else 0.0


def lines(rows: Mask) -> str:
    """Rows of a table as lines of its file, in words: the header is line 1."""
    edges = np.flatnonzero(np.diff(np.concatenate(([0], rows.astype(np.int8), [0]))))
    spans = [
        f"{a + 2}" if b == a + 1 else f"{a + 2}-{b + 1}" for a, b in edges.reshape(-1, 2)[:5].tolist()
    ]
    more = edges.size // 2 - len(spans)
    which = "line" if rows.sum() == 1 else "lines"
    return f"{which} {', '.join(spans)}" + (f" and {more} more" if more else "")


def _told(file: str, column: str, what: str, rows: Mask) -> str:
    kept = (
        "these samples are not used" if column in SENSORS else "used as it is: correct or cut these rows"
    )
    return f"{file}: {column} {what} in {rows.sum()} of {rows.size} samples, {lines(rows)}; {kept}"


def _runs(values: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """First index and length of every run of equal values."""
    starts = np.flatnonzero(np.concatenate(([True], np.diff(values) != 0)))[: values.size]
    return starts, np.diff(np.concatenate((starts, [values.size])))


def _seen_scatter(values: Array, claim: float) -> float:
    """The smaller of claimed and found scatter; 0 where readings do not show any to go by."""
    found = scatter(values)
    if not claim > 0 or found < BELIEVED_SCATTER * claim:
        return 0.0
    least = min(claim, found) if math.isfinite(found) else claim
    return least if least >= 0.5 * quantum(values) else 0.0


def _saturated(values: Array, claim: float) -> Mask:
    """More readings are at the end of the range than within one scatter of it."""
    rows = np.zeros(values.size, bool)
    width = max(_seen_scatter(values, claim), quantum(values))
    if _seen_scatter(values, claim) == 0 or np.nanmin(values) == np.nanmax(values):
        return rows
    for end in (np.nanmin(values), np.nanmax(values)):
        at, near = values == end, np.abs(values - end) <= SATURATED_NEAR_SIGMA * width
        if at.sum() >= SATURATED_LEAST_RUN and at.sum() > SATURATED_SHARE * near.sum():
            rows |= at
    # Between samples at the end, those that noise alone took off it are no better.
    return np.convolve(rows, np.ones(2 * SATURATED_BESIDE + 1), "same") > 0 if rows.any() else rows


def _frozen(time_s: Array, values: Array, claim: float) -> Mask:
    finite = np.flatnonzero(np.isfinite(values))
    starts, lengths = _runs(values[finite])
    noise = _seen_scatter(values, claim)
    rows = np.zeros(values.size, bool)
    if noise == 0 or finite.size == 0:
        return rows
    repeat = math.erf(quantum(values) / (2 * math.sqrt(2) * noise))
    chance = math.log(FALSE_ALARM_CHANCE / finite.size) / math.log(max(repeat, 1e-12))
    # A slow sensor in a fast log holds every reading for a while: that is its habit.
    usual = float(np.median(lengths)) if lengths.size > 1 else 0.0
    least = max(FROZEN_LEAST_RUN, chance + 1, FROZEN_TIMES_USUAL_RUN * usual)
    lasted = time_s[finite[starts + lengths - 1]] - time_s[finite[starts]]
    rows[finite[np.repeat((lengths >= least) & (lasted >= FROZEN_LEAST_S), lengths)]] = True
    return rows


def _spikes(values: Array, claim: float) -> Mask:
    """One or two samples far off, while the two before and the two after agree."""
    rows = np.zeros(values.size, bool)
    finite = np.flatnonzero(np.isfinite(values))
    noise = np.nanmax([claim, scatter(values)])
    for width in (1, 2):
        if finite.size < width + 4 or not noise > 0:
            continue
        windows = sliding_window_view(values[finite], width + 4)
        beside, inside = windows[:, [0, 1, -2, -1]], windows[:, 2:-2]
        jump = np.abs(inside - np.median(beside, axis=1, keepdims=True)).min(axis=1)
        found = np.flatnonzero(
            (jump > SPIKE_SIGMA * noise) & (np.ptp(beside, axis=1) < SPIKE_SHARE * jump)
        )
        for k in range(width):
            rows[finite[found + 2 + k]] = True
    return rows


def _alone(name: str, spikes: Mapping[str, Mask]) -> Mask:
    """Spikes of one signal that base angle and others do not share: not motion."""
    others = [rows for other, rows in spikes.items() if other != name]
    shared = np.logical_or.reduce(others) if others else np.zeros_like(spikes[name])
    shared[1:] |= shared[:-1].copy()
    shared[:-1] |= shared[1:].copy()
    return spikes[name] & ~shared

"""Applies a mapping: the lab files of a trial become one table of rig-log/1.

Columns that share one clock become rows as they are. Columns with separate clocks need a stated
rate. Times start at 0.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import pandas as pd
from scipy.integrate import cumulative_trapezoid

from diagnosis.criteria.lab_files import DERIVATIVE_WINDOW_S
from diagnosis.lab_files.mapping import FIRST_REST, ColumnSource, ImportMapping, TrialSource
from diagnosis.lab_files.motion import motion_of
from diagnosis.lab_files.readers.lab_table import Array, LabFile
from diagnosis.lab_files.resampling import resampled, told
from diagnosis.lab_files.series import Series, raw_series
from diagnosis.log.trial import COLUMNS, REQUIRED
from models.errors import InvalidValue

_TURN_DEG = 360.0


@dataclass(frozen=True, kw_only=True)
class ImportedTrial:
    """A trial in the columns of rig-log/1, and how it was made."""

    name: str
    table: pd.DataFrame
    notes: tuple[str, ...]


def imported_trial(
    mapping: ImportMapping, trial: TrialSource, files: Sequence[LabFile]
) -> ImportedTrial:
    """The table of a trial.

    Args:
      files: all given files; those that the trial names are used.

    Raises:
      InvalidValue: names the file and column, what was expected and found, and the fix.
    """
    raw = {name: raw_series(mapping, trial, files, name) for name in mapping.columns}
    scaled = _scaled(mapping, raw)
    clocks = {one.clock for one in scaled.values()}
    if mapping.resample_hz is None and len(clocks) > 1:
        listed = "; ".join(f"{name} of {one.where}" for name, one in scaled.items())
        raise InvalidValue(
            f"{trial.file}: resample_hz",
            None,
            "a number of rows per second, because these columns have different clocks: " + listed,
            "e.g. resample_hz: 100; or remove 'time_offset_s' where there is none",
        )
    columns, notes = (
        _rows(trial, scaled) if mapping.resample_hz is None else _even(mapping, trial, scaled)
    )
    for name in COLUMNS:
        value = mapping.constant(trial, name)
        if value is not None:
            columns[name] = np.full(columns["time_s"].size, value)
    table = pd.DataFrame({name: columns[name] for name in COLUMNS if name in columns})
    return ImportedTrial(name=trial.file, table=table, notes=tuple(notes))


def _scaled(mapping: ImportMapping, raw: Mapping[str, Series]) -> dict[str, Series]:
    """Series in the units of rig-log/1; zeros from rests need the motion of the base."""
    motion = None
    found = {}
    for name, one in raw.items():
        source = mapping.columns[name]
        zero = source.zero
        if zero == FIRST_REST:
            base = raw.get("base_angle_deg")
            if base is None:
                raise InvalidValue(f"{one.where}: zero", FIRST_REST, "a column of base_angle_deg")
            motion = motion or motion_of(base.time_s, base.values)
            resting = one.values[motion.in_first_rest(one.time_s)]
            if not np.isfinite(resting).any():
                raise InvalidValue(
                    f"{one.where}: zero", FIRST_REST, "a trial that starts at rest", "state a number"
                )
            zero = float(np.nanmean(resting))
        values = source.scale(name) * (one.values - float(zero))
        values = _unwrapped(values) if source.unwrap else values
        found[name] = Series(
            time_s=one.time_s,
            values=_derived(source, one.time_s, values),
            where=one.where,
            clock=one.clock,
        )
    return found


def _unwrapped(values_deg: Array) -> Array:
    """An angle that counts on, deg; empty readings stay empty."""
    counted, good = values_deg.copy(), np.isfinite(values_deg)
    counted[good] = np.unwrap(values_deg[good], period=_TURN_DEG)
    return counted


def _derived(source: ColumnSource, time_s: Array, values: Array) -> Array:
    if source.derive is None:
        return values
    good = np.isfinite(values)
    known = np.interp(time_s, time_s[good], values[good])
    if source.derive == "integrate":
        return source.start + np.asarray(cumulative_trapezoid(known, time_s, initial=0))
    ahead = np.minimum(time_s + DERIVATIVE_WINDOW_S / 2, time_s[-1])
    behind = np.maximum(time_s - DERIVATIVE_WINDOW_S / 2, time_s[0])
    moved = np.interp(ahead, time_s, known) - np.interp(behind, time_s, known)
    return np.asarray(moved / (ahead - behind))


def _rows(trial: TrialSource, series: Mapping[str, Series]) -> tuple[dict[str, Array], list[str]]:
    """Rows as they are; a required column without a number is an error."""
    time_s = next(iter(series.values())).time_s
    for name, one in series.items():
        empty = np.flatnonzero(~np.isfinite(one.values))
        if name in REQUIRED and empty.size:
            raise InvalidValue(
                f"{one.where}, row {empty[0] + 1}",
                "an empty cell",
                f"a number for {name} in every row ({empty.size} of {one.values.size} are empty)",
                "remove these rows; or state 'resample_hz' if the column is sampled less often",
            )
    columns = {"time_s": time_s - time_s[0]}
    columns |= {name: one.values for name, one in series.items()}
    return columns, [f"{trial.file}: {time_s.size} rows, unchanged"]


def _even(
    mapping: ImportMapping, trial: TrialSource, series: Mapping[str, Series]
) -> tuple[dict[str, Array], list[str]]:
    """Rows at a stated rate, where all required columns have samples."""
    hz = float(mapping.resample_hz or 1.0)
    required = {name: one for name, one in series.items() if name in REQUIRED} or series
    first = max(_finite_times(one)[0] for one in required.values())
    last = min(_finite_times(one)[-1] for one in required.values())
    if last - first < 2 / hz:
        spans = [
            f"{n} {_finite_times(s)[0]:.3f} to {_finite_times(s)[-1]:.3f} s" for n, s in series.items()
        ]
        raise InvalidValue(
            f"{trial.file}: times",
            "; ".join(spans),
            "columns that overlap in time",
            "state 'time_offset_s'",
        )
    wanted_s = first + np.arange(int((last - first) * hz * (1 + 1e-12)) + 1) / hz
    columns = {"time_s": wanted_s - wanted_s[0]}
    notes = []
    for name, one in series.items():
        across = name in REQUIRED
        columns[name] = resampled(one.time_s, one.values, wanted_s, across_gaps=across)
        if across:
            columns[name] = np.interp(
                wanted_s, wanted_s[np.isfinite(columns[name])], columns[name][np.isfinite(columns[name])]
            )
        notes.append(f"{trial.file}: {name}: {told(_finite_times(one), hz)}")
    return columns, notes


def _finite_times(one: Series) -> Array:
    good = one.time_s[np.isfinite(one.values)]
    if good.size < 2:
        raise InvalidValue(one.where, f"{good.size} numbers", "at least two numbers")
    return good

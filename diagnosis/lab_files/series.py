"""A column of a lab's files with its own times, found by a mapping, with unchanged values."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.lab_files.mapping import ColumnSource, ImportMapping, TrialSource
from diagnosis.lab_files.readers.lab_table import Array, LabFile, LabTable
from models.errors import InvalidValue


class NoTimes(InvalidValue):
    """A table has no column of times, and no sampling rate is stated."""


@dataclass(frozen=True, kw_only=True)
class Series:
    """One column with its own times.

    Attributes:
      time_s: (N,), with the offset of its clock.
      values: (N,).
      where: file and column, for messages.
      clock: identifies the clock of the table with its offset: series of one clock have the same times.
    """

    time_s: Array
    values: Array
    where: str
    clock: tuple[str, float]


def raw_series(
    mapping: ImportMapping, trial: TrialSource, files: Sequence[LabFile], wanted: str
) -> Series:
    """A column of the lab with its times in seconds, and its values as in the file.

    Raises:
      InvalidValue: the file, the column or its times are missing, or times do not increase.
    """
    source = mapping.columns[wanted]
    table = _table_with(trial, files, wanted, source)
    where = f"{table.title}, column {source.column!r}"
    time_s = _times(mapping, table) + source.time_offset_s
    back = np.flatnonzero(np.diff(time_s) <= 0)
    if back.size or not np.isfinite(time_s).all():
        row = int(back[0]) + 2 if back.size else int(np.flatnonzero(~np.isfinite(time_s))[0]) + 1
        raise InvalidValue(
            f"{table.title}: times, row {row}",
            float(time_s[row - 1]),
            "a time after that of the row before",
            "remove or sort such rows; or state 'sample_hz' and no 'times' if samples are evenly spaced",
        )
    clock = (table.title, source.time_offset_s)
    return Series(time_s=time_s, values=table.columns[str(source.column)], where=where, clock=clock)


def _table_with(
    trial: TrialSource, files: Sequence[LabFile], wanted: str, source: ColumnSource
) -> LabTable:
    by_name = {file.path.name: file for file in files}
    missing = [name for name in trial.lab_files if name not in by_name]
    if missing:
        raise InvalidValue(
            f"trials.{trial.file}.lab_files",
            missing,
            f"names among the files given: {', '.join(by_name)}",
        )
    if source.file is not None and not 1 <= source.file <= len(trial.lab_files):
        raise InvalidValue(f"columns.{wanted}.file", source.file, f"1 to {len(trial.lab_files)}")
    chosen = trial.lab_files if source.file is None else (trial.lab_files[source.file - 1],)
    tables = [table for name in chosen for table in by_name[name].tables]
    having = [table for table in tables if source.column in table.columns]
    if len(having) == 1:
        return having[0]
    if having:
        raise InvalidValue(
            f"columns.{wanted}.column ({trial.file})",
            source.column,
            f"a column that only one of {', '.join(trial.lab_files)} has",
            f"{len(having)} tables have it: state 'file', the number of the one that is meant, from 1",
        )
    known = [name for table in tables for name in table.columns]
    raise InvalidValue(
        f"columns.{wanted}.column ({trial.file})", source.column, "one of " + ", ".join(map(repr, known))
    )


def _times(mapping: ImportMapping, table: LabTable) -> Array:
    for time in mapping.times:
        if time.column in table.columns:
            return time.seconds * table.columns[time.column]
    if mapping.sample_hz is not None:
        return np.arange(table.rows) / mapping.sample_hz
    raise NoTimes(
        f"{table.title}: times",
        ", ".join(time.column for time in mapping.times) or None,
        "a column of this file under 'times', or 'sample_hz'",
        "name the column that holds its times, or state its samples per second",
    )


def refuse_unreadable(mapping: ImportMapping, files: Sequence[LabFile]) -> None:
    """Check that every column of every trial exists, before any is used.

    Raises:
      InvalidValue: lists all that are missing.
    """
    found: dict[str, InvalidValue] = {}
    for trial in mapping.trials:
        for wanted in mapping.columns:
            try:
                raw_series(mapping, trial, files, wanted)
            except InvalidValue as error:
                found.setdefault(str(error), error)
    if len(found) == 1:
        raise next(iter(found.values()))
    if found:
        listed = "\n  ".join(found)
        raise InvalidValue(
            "mapping",
            f"{len(found)} problems",
            "columns that are in the files",
            f"these are:\n  {listed}",
        )

"""Reads a trial: one CSV, one row per sample.

Nothing is guessed or repaired: a violation of the format is an error that names the file, the
line or column, what was expected, what was found, and the fix.
"""

import csv
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria.log import (
    FEWEST_ROWS,
    LONGEST_SAMPLE_S,
    MOST_BYTES_PER_ROW,
    MOST_LOST_ROWS,
    MOST_ROWS,
    READING_RANGE,
    SHORTEST_SAMPLE_S,
)
from diagnosis.log.trial import COLUMNS, OPTIONAL, Trial, UnusableLog
from diagnosis.log.trial_header import NO_TEXT, check_header
from models.names import is_file, is_folder

Array = NDArray[np.float64]

_CHUNK_BYTES = 1 << 20
_WRITE = "write numbers with a decimal point, and commas between the cells only"


def refuse_too_large(paths: Sequence[Path]) -> None:
    """Check that trials exist and together do not have too many rows, before any is read.

    Lines are counted in chunks, and no further than the limit: fast, with little memory.

    Raises:
      UnusableLog: names the first file that is missing or exceeds the limit.
    """
    size, lines = 0, 0
    for path in paths:
        if not is_file(path):
            found = "a folder" if is_folder(path) else "no such file"
            raise UnusableLog(f"{path}: expected a CSV file, found {found}; see 'trials' in rig.yaml")
        size += path.stat().st_size
        if size <= MOST_ROWS * MOST_BYTES_PER_ROW:
            lines += _count_lines(path, most=MOST_ROWS + len(paths) - lines)
        if size > MOST_ROWS * MOST_BYTES_PER_ROW or lines > MOST_ROWS + len(paths):
            raise UnusableLog(
                f"{path}: with this file the log is too large; expected at most {MOST_ROWS} rows in all "
                f"trials together; decimate it, e.g. keep every 10th row: 100 rows per second are plenty"
            )


def read_trial(path: Path) -> Trial:
    """Read and check a trial.

    Raises:
      UnusableLog: names the file, the line or column, and how to fix it.
    """
    try:
        check_header(path)
        # A text file stays one, whatever its name ends in.
        table = pd.read_csv(
            path,
            encoding="utf-8-sig",
            compression=None,
            skipinitialspace=True,
            skip_blank_lines=False,
            low_memory=False,
        )
    except UnicodeDecodeError as error:
        raise UnusableLog(f"{path}: {NO_TEXT}") from error
    except (OSError, ValueError, csv.Error) as error:
        raise UnusableLog(
            f"{path}: expected a readable CSV file; {str(error).strip()}; {_WRITE}"
        ) from error
    table = _known_columns(table)
    for name in table:
        table[name] = _numbers(path, table[name], empty_allowed=name in OPTIONAL)
    _check_time(path, np.asarray(table["time_s"]))
    return Trial(name=path.name, table=table)


def _count_lines(path: Path, *, most: int) -> int:
    """Lines of a file, or some number above `most` if it has more."""
    lines = 0
    try:
        with path.open("rb") as file:
            while lines <= most and (chunk := file.read(_CHUNK_BYTES)):
                lines += chunk.count(b"\n")
    except OSError as error:
        raise UnusableLog(f"{path}: expected a readable CSV file; {error}") from error
    return lines


def _known_columns(table: pd.DataFrame) -> pd.DataFrame:
    """The columns of the format, without blank lines at the end."""
    table = table.rename(columns=str.strip)
    table = table[[name for name in COLUMNS if name in table.columns]]
    filled = np.flatnonzero(table.notna().any(axis=1))
    return table.iloc[: filled[-1] + 1 if filled.size else 0].copy()


def _floats(column: pd.Series) -> pd.Series:
    """A column as floats; NaN for words. Integers beyond the range of floats become infinite."""
    is_read = pd.api.types.is_float_dtype(column)
    return pd.to_numeric(column if is_read else column.astype(str), errors="coerce").astype(float)


def _numbers(path: Path, column: pd.Series, *, empty_allowed: bool) -> pd.Series:
    """A column as finite, plausible numbers; NaN where an optional one is empty."""
    values = _floats(column)
    low, high = READING_RANGE[str(column.name)]
    empty = column.isna() if empty_allowed else np.zeros(len(column), bool)
    wrong = np.flatnonzero(~(values.between(low, high) | empty))
    if wrong.size:
        row = int(wrong[0])
        span = f"{round(low, 3) + 0.0:g} to {high:g}"
        got = "an empty cell or NaN" if pd.isna(column.iloc[row]) else repr(str(column.iloc[row])[:40])
        fix = "leave cells empty where the sensor gave nothing" if empty_allowed else "correct the row"
        raise UnusableLog(
            f"{path}, line {row + 2}, column {column.name!r}: expected a number from {span}, "
            f"found {got}; {fix}; check unit and order of the columns"
        )
    return values


def _check_time(path: Path, time_s: Array) -> None:
    if time_s.size < FEWEST_ROWS:
        raise UnusableLog(
            f"{path}: expected at least {FEWEST_ROWS} rows (far more are useful), found {time_s.size}; "
            "take the trial out of rig.yaml, or record it longer"
        )
    steps = np.diff(time_s)
    back = np.flatnonzero(steps <= 0)
    if back.size:
        row = int(back[0]) + 1
        fix = "remove one of the two rows" if steps[row - 1] == 0 else "sort the rows by time"
        raise UnusableLog(
            f"{path}, line {row + 2}, column 'time_s': expected a time after {time_s[row - 1]:.9g} "
            f"of the line above, found {time_s[row]:.9g}; {fix}"
        )
    if np.median(steps) < SHORTEST_SAMPLE_S:
        raise UnusableLog(
            f"{path}, column 'time_s': expected samples at least {SHORTEST_SAMPLE_S:g} s apart, found "
            f"{np.median(steps):.3g} s; convert the times to seconds"
        )
    if np.median(steps) > LONGEST_SAMPLE_S:
        raise UnusableLog(
            f"{path}, column 'time_s': expected samples at most {LONGEST_SAMPLE_S:g} s apart, found "
            f"{np.median(steps):g} s; if these are milliseconds, divide by 1000"
        )
    _refuse_long_pauses(path, time_s)


def _refuse_long_pauses(path: Path, time_s: Array) -> None:
    """Refuse pauses that are too long: they are replayed step by step, which would take too long."""
    steps = np.diff(time_s)
    lost = steps / np.median(steps)
    row = int(np.argmax(lost))
    if lost[row] > MOST_LOST_ROWS or lost.sum() > MOST_ROWS:
        raise UnusableLog(
            f"{path}, line {row + 3}, column 'time_s': expected a time within {MOST_LOST_ROWS} median "
            f"steps of the line above, found a pause of {steps[row]:.6g} s, {lost[row]:.3g} steps, "
            f"all of which would be replayed (of a trial: at most {MOST_ROWS}); make two trials of it"
        )

"""The times of each table: a column that is called so, else one that rises by equal steps as a question.

Without either the user states a sampling rate: numbers in the file that may be one are told.
"""

from collections.abc import Iterator, Sequence

import numpy as np

from diagnosis.criteria.lab_files import EVEN_STEPS, MOST_BACKWARDS
from diagnosis.lab_files.guesses.guessed import GuessedTimes
from diagnosis.lab_files.guesses.name_scores import has_word, weight_of
from diagnosis.lab_files.guesses.names import guessed_columns
from diagnosis.lab_files.guesses.unit_guess import guessed_unit
from diagnosis.lab_files.mapping import TimeSource
from diagnosis.lab_files.readers.lab_table import Array, LabFile, LabTable
from diagnosis.lab_files.units import MeasuredQuantity, factor_of, is_unit, unit_in
from diagnosis.log.unit_hints import words_of

_TIME = {"stamp": 5, "timestamp*": 5, "time*": 4, "t": 4, "zeit": 4, "clock": 2}
_INTERVAL, _RATE = "interval dt step period abtastzeit", "fs rate freq* hz samplerate abtastrate"


def guessed_time_columns(files: Sequence[LabFile], open_: list[str]) -> list[GuessedTimes]:
    """The column of times of each table.

    Args:
      open_: list to which open questions for the user are added.
    """
    found: dict[str, GuessedTimes] = {}
    for file in files:
        for table in file.tables:
            name = times_of(table)
            if name is None:
                open_.append(_no_times(file, table))
            elif name not in found:
                found[name] = _guessed_time(table, name, open_)
    return list(found.values())


def times_of(table: LabTable) -> str | None:
    """The column of times of a table, by its name or, failing that, by its equal steps; None: none."""
    return _called_times(table) or next(_evenly_rising(table), None)


def _called_times(table: LabTable) -> str | None:
    """The column with the name of a time and values that nearly all increase."""
    rising = [name for name, values in table.columns.items() if _rises(values)]
    scored = {name: weight_of(words_of(name), _TIME) for name in rising}
    best = max(scored, key=lambda name: scored[name], default=None)
    return best if best is not None and scored[best] > 0 else None


def _evenly_rising(table: LabTable) -> Iterator[str]:
    """Columns of equal steps that are called nothing else, and do more than count the rows."""
    others = {guess.column for guess in guessed_columns([table], [])}
    for name, values in table.columns.items():
        unit = unit_in(name) or name
        foreign = is_unit(unit) and factor_of(unit, MeasuredQuantity.TIME) is None
        if name not in others and not foreign and _has_equal_steps(values) and not _counts(values):
            yield name


def _guessed_time(table: LabTable, name: str, open_: list[str]) -> GuessedTimes:
    ros = table.ros_units or name.endswith(".log_time")
    unit = guessed_unit(name, table.columns[name], MeasuredQuantity.TIME, ros_units=ros)
    if not unit.known:
        open_.append(f"times.{name}: {unit.reason} write it in the line 'unit'")
    called = _called_times(table) is not None
    source = TimeSource(column=name, unit=unit.unit, guess=unit.asked or not called)
    if called:
        return GuessedTimes(source=source, because="by its name; it rises", reason=unit.reason)
    steps = f"it rises by equal steps of {_step(table.columns[name]):.4g}"
    open_.append(
        f"times: no column of {table.title} is called a time; {name!r}: {steps}: is it the time?"
    )
    return GuessedTimes(source=source, because=steps, reason=unit.reason)


def _no_times(file: LabFile, table: LabTable) -> str:
    """What is missing, and all in the file that may help to state it."""
    counters = [name for name, values in table.columns.items() if _counts(values)]
    told = [f"{name!r} counts the rows" for name in counters[:1]]
    told += _rates({**file.scalars, **_constant_intervals(table)})
    beside = f" ({'; '.join(told)})" if told else ""
    return (
        f"times: no column of {table.title} was recognised as times: name it under 'times', or state "
        f"'sample_hz', the samples per second{beside}"
    )


def _constant_intervals(table: LabTable) -> dict[str, float]:
    """Columns that hold the same time between samples in every row."""
    return {
        name: float(values[0])
        for name, values in table.columns.items()
        if has_word(words_of(name), _INTERVAL) and values[0] > 0 and (values == values[0]).all()
    }


def _rates(numbers: dict[str, float]) -> list[str]:
    """Numbers that may be a sampling rate, or its inverse; all of them if no name says so."""
    rates = {name: value for name, value in numbers.items() if has_word(words_of(name), _RATE)}
    found = [f"sample_hz: {value:g}, if {name!r} is it" for name, value in rates.items()]
    for name, value in numbers.items():
        unit = unit_in(name) or "s"
        seconds = factor_of(unit, MeasuredQuantity.TIME)
        if has_word(words_of(name), _INTERVAL) and seconds and value > 0:
            hz = f"{1 / (seconds * value):.6g}"
            found.append(f"sample_hz: {hz}, if {name!r} = {value:g} is in {unit}")
    return found or [f"in the file: {name} = {value:g}" for name, value in numbers.items()]


def _rises(values: Array) -> bool:
    steps = np.diff(values)
    if not steps.size or not np.isfinite(values).all() or not steps.any():
        return False
    return bool(np.mean(steps < 0) <= MOST_BACKWARDS)


def _has_equal_steps(values: Array) -> bool:
    steps = np.diff(values)
    if steps.size < 2 or not np.isfinite(values).all() or steps.min() <= 0:
        return False
    return bool(np.ptp(steps) <= EVEN_STEPS * _step(values))


def _counts(values: Array) -> bool:
    """Whether a column is 0, 1, 2 or 1, 2, 3: it counts the rows."""
    return bool(values.size > 2 and values[0] in (0, 1) and (np.diff(values) == 1).all())


def _step(values: Array) -> float:
    return float(np.median(np.diff(values)))

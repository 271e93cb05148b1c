"""Trials and columns of a draft: what names and numbers tell, without the motion."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from diagnosis.lab_files.guesses.guessed import GuessedColumn, GuessedTimes
from diagnosis.lab_files.guesses.names import (
    NameGuess,
    angular_rate,
    guessed_columns,
    is_rate_of,
)
from diagnosis.lab_files.guesses.times import times_of
from diagnosis.lab_files.guesses.unit_guess import UnitGuess, guessed_unit
from diagnosis.lab_files.mapping import ColumnSource, TrialSource
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.units import MeasuredQuantity
from diagnosis.log.trial import REQUIRED, SENSORS

Open = list[str]


def guessed_trials(files: Sequence[LabFile], open_: Open) -> list[TrialSource]:
    """Each file of one kind is a trial; if there are as many files of other kinds, one of each is.

    Args:
      open_: list to which open questions for the user are added.
    """
    kinds: dict[Any, list[str]] = {}
    for file in files:
        kinds.setdefault(file.header, []).append(file.path.name)
    if len({len(names) for names in kinds.values()}) > 1:
        listed = "; ".join(", ".join(names) for names in kinds.values())
        open_.append(f"trials: which files belong together? files of one kind: {listed}")
    together = zip(*kinds.values(), strict=False)
    return [
        TrialSource(file=f"trial_{i + 1:02d}.csv", lab_files=names, guess=len(kinds) > 1)
        for i, names in enumerate(together)
    ]


def guessed_sources(
    tables: Sequence[LabTable], times: Sequence[GuessedTimes], open_: Open
) -> list[GuessedColumn]:
    """Columns by name and unit; what is derived from others; what is missing."""
    taken = {time.source.column for time in times}
    guesses = guessed_columns(tables, taken)
    rates = _rates_of_the_base(guesses)
    for guess in rates:
        open_.append(f"{guess.column!r} is the rate of the base angle, not an axial speed: left out")
    guesses = guessed_columns(tables, taken | {guess.column for guess in rates})
    found = [_guessed_column(guess, None, open_) for guess in guesses]
    by_name = {guess.wanted: guess for guess in guesses}
    if "base_angle_deg" not in by_name:
        rate = angular_rate(tables, {guess.column for guess in guesses})
        if rate:
            guess = NameGuess(wanted="base_angle_deg", table=rate[0], column=rate[1])
            found.insert(0, _guessed_column(guess, "integrate", open_))
    depth = by_name.get("inserted_mm")
    if "speed_mm_s" not in by_name and depth and np.ptp(depth.table.columns[depth.column]) > 0:
        guess = NameGuess(wanted="speed_mm_s", table=depth.table, column=depth.column)
        found.append(_guessed_column(guess, "differentiate", open_))
    have = {column.wanted for column in found}
    open_ += [
        f"{n}: no column with a matching name; {_without(n)}"
        for n in (*REQUIRED, *SENSORS)
        if n not in have and n != "time_s"
    ]
    order = (*REQUIRED, *SENSORS, "tip_torque_n_mm")
    return sorted(found, key=lambda column: order.index(column.wanted))


def _guessed_column(guess: NameGuess, derive: Any, open_: Open) -> GuessedColumn:
    table, name, wanted = guess.table, guess.column, guess.wanted
    quantity = ColumnSource(column=name, derive=derive).quantity(wanted) or MeasuredQuantity.ANGLE
    unit = guessed_unit(name, table.columns[name], quantity, ros_units=table.ros_units)
    joint = f" and that of its joint, {table.words[name]!r}" if name in table.words else ""
    reasons = {"column": f"by its name{joint}", "unit": unit.reason}
    if guess.alike:
        others = ", ".join(map(repr, guess.alike))
        reasons["column"] += f"; {others} match as well; this one varies most"
    if derive:
        reasons["derive"] = f"no column of {wanted}; computed from this one"
    if unit.asked:
        open_.append(f"{wanted}: unit of {name!r}: {unit.reason}{_answer(unit, quantity)}")
    source = ColumnSource(column=name, unit=unit.unit, derive=derive, guess=True)
    return GuessedColumn(wanted=wanted, source=source, reasons=reasons, known=unit.known)


def _answer(unit: UnitGuess, quantity: MeasuredQuantity) -> str:
    """What to write in the mapping where the question of a unit is open."""
    if unit.known:
        return ""
    if unit.unit is not None:
        return " write it in the line 'factor'"
    factor = f"'factor', {quantity} per unit of the file"
    return f" write it in the line 'unit', e.g. {quantity}; or add {factor}"


def _rates_of_the_base(guesses: Sequence[NameGuess]) -> list[NameGuess]:
    """Columns that are named a speed and are the rate of the column that is named the angle."""
    by_name = {guess.wanted: guess for guess in guesses}
    speed, base = by_name.get("speed_mm_s"), by_name.get("base_angle_deg")
    if speed is None or base is None or speed.table is not base.table:
        return []
    columns, time = base.table.columns, times_of(base.table)
    if time is None or not is_rate_of(columns[speed.column], columns[time], columns[base.column]):
        return []
    return [speed]


def _without(wanted: str) -> str:
    if wanted in SENSORS:
        return "add it if it was measured"
    return "name it" if wanted == "base_angle_deg" else "name it, or state a number under 'constants'"

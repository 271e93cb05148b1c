"""Matches a lab's columns to those of rig-log/1, by the words of their names and their units.

A column that is only the rate of the base's angle is not the axial speed, whatever its name: the data
decide.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from diagnosis.criteria.lab_files import NAME_LEAST_SCORE, SAME_MOTION
from diagnosis.lab_files.guesses.name_scores import (
    BASE,
    COMMANDED,
    RATE,
    TIP,
    all_words,
    has_word,
    score_of,
    span_of,
)
from diagnosis.lab_files.readers.lab_table import Array, LabTable
from diagnosis.lab_files.units import QUANTITIES, MeasuredQuantity, factor_of, unit_in


@dataclass(frozen=True, kw_only=True)
class NameGuess:
    """A lab's column that matches one of rig-log/1.

    Attributes:
      table: title of its table.
      alike: other columns whose names match equally well.
    """

    wanted: str
    table: LabTable
    column: str
    alike: tuple[str, ...] = ()


def guessed_columns(tables: Sequence[LabTable], taken: Iterable[str]) -> tuple[NameGuess, ...]:
    """The best columns for rig-log/1, each used once.

    Args:
      tables: tables of one trial.
      taken: columns with another use: times, rates of others.
    """
    taken = set(taken)
    scored = [
        (score_of(wanted, table, name), span_of(table.columns[name]), wanted, table, name)
        for table in tables
        for name in table.columns
        if name not in taken and not name.endswith(".log_time")
        for wanted in QUANTITIES
        if wanted != "time_s"
    ]
    scored = [one for one in scored if one[0] >= NAME_LEAST_SCORE]
    found: list[NameGuess] = []
    for score, _, wanted, table, name in sorted(scored, key=lambda one: one[:2], reverse=True):
        if any(g.wanted == wanted or (g.table is table and g.column == name) for g in found):
            continue
        alike = tuple(n for s, _, w, _, n in scored if w == wanted and n != name and s == score)
        found.append(NameGuess(wanted=wanted, table=table, column=name, alike=alike))
    return tuple(found)


def angular_rate(tables: Sequence[LabTable], used: Iterable[str]) -> tuple[LabTable, str] | None:
    """Table and name of a rate of the base, from which its angle could be integrated; None: none."""
    used = set(used)
    for table in tables:
        for name in table.columns:
            words, unit = all_words(table, name), unit_in(name)
            turns = factor_of(unit, MeasuredQuantity.ANGULAR_RATE) is not None
            called = (
                has_word(words, RATE)
                and has_word(words, BASE)
                and not factor_of(unit, MeasuredQuantity.SPEED)
            )
            if name not in used and (turns or called) and not has_word(words, f"{TIP} {COMMANDED}"):
                return table, name
    return None


def is_rate_of(values: Array, time_s: Array, position: Array) -> bool:
    """Whether a column is the rate of another one of the same table, (N,) each."""
    good = np.isfinite(values) & np.isfinite(position) & (np.gradient(time_s) > 0)
    if good.sum() <= 2 or np.ptp(values[good]) == 0 or np.ptp(position[good]) == 0:
        return False
    width = np.ones(5) / 5
    rate = np.convolve(np.gradient(position[good], time_s[good]), width, "same")
    smooth = np.convolve(values[good], width, "same")
    return bool(np.ptp(rate) > 0 and abs(np.corrcoef(smooth, rate)[0, 1]) >= SAME_MOTION)

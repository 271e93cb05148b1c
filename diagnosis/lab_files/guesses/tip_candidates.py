"""Columns that may be the angle of the tip though no name says so: they are told, and never chosen."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np

from diagnosis.criteria.lab_files import TIP_LEAST_CORRELATION
from diagnosis.lab_files.guesses.guessed import GuessedColumn
from diagnosis.lab_files.guesses.name_scores import is_called_an_angle
from diagnosis.lab_files.readers.lab_table import Array, LabTable
from diagnosis.lab_files.units import unit_in


@dataclass(frozen=True, kw_only=True)
class TipCandidate:
    """A column that is called an angle and turns like the base.

    Attributes:
      unit: as in its name; empty if there is none.
      sign: -1 if it turns the other way.
      reason: in words, as a question.
    """

    column: str
    unit: str
    sign: Literal[1, -1]
    reason: str


def tip_candidates(
    columns: Sequence[GuessedColumn], tables: Sequence[LabTable], unused: Iterable[str]
) -> tuple[TipCandidate, ...]:
    """Unused columns beside the base's that turn like it; none if there is a tip, or no base."""
    by_name = {column.wanted: column.source for column in columns}
    base = by_name.get("base_angle_deg")
    if "tip_angle_deg" in by_name or base is None or base.derive or base.column is None:
        return ()
    found = []
    for table in (table for table in tables if base.column in table.columns):
        for name in table.columns:
            if name in unused and is_called_an_angle(table, name):
                match = _correlation(table.columns[base.column], table.columns[name])
                if abs(match) >= TIP_LEAST_CORRELATION:
                    reason = f"it turns like the base (correlation {match:+.2f}): is it at the tip?"
                    sign: Literal[1, -1] = 1 if match > 0 else -1
                    unit = unit_in(name)
                    found.append(TipCandidate(column=name, unit=unit, sign=sign, reason=reason))
    return tuple(found)


def _correlation(base: Array, other: Array) -> float:
    good = np.isfinite(base) & np.isfinite(other)
    if good.sum() <= 2 or np.ptp(base[good]) == 0 or np.ptp(other[good]) == 0:
        return 0.0
    return float(np.corrcoef(base[good], other[good])[0, 1])

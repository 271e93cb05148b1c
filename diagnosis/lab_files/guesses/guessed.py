"""A guess: where a column probably comes from, and why."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from diagnosis.lab_files.mapping import ColumnSource, TimeSource


@dataclass(frozen=True, kw_only=True)
class GuessedTimes:
    """A column with times, and the reason of its unit."""

    source: TimeSource
    reason: str


@dataclass(frozen=True, kw_only=True)
class GuessedColumn:
    """A column of rig-log/1 with its guessed source.

    Attributes:
      reasons: by field of the source.
      known: whether its scale is known.
    """

    wanted: str
    source: ColumnSource
    reasons: Mapping[str, str]
    known: bool

    @property
    def scale(self) -> float:
        """Units of rig-log/1 per unit of the file, with the sign; 1 where it is open."""
        return self.source.scale(self.wanted)

    def with_guess(self, field: str, reason: str, **change: Any) -> "GuessedColumn":
        """The same with one more guess."""
        reasons = {**self.reasons, field: reason}
        return replace(self, source=self.source.but(**change), reasons=reasons)

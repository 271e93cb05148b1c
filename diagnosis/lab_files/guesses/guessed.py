"""A guess: the probable source of a column, and the reasons."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

from diagnosis.lab_files.mapping import ColumnSource, TimeSource


@dataclass(frozen=True, kw_only=True)
class GuessedTimes:
    """A column of times, why it is one, and the reason for its unit."""

    source: TimeSource
    because: str
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
        """Units of rig-log/1 per unit of the file, with the sign; 1 if unknown."""
        return self.source.scale(self.wanted)

    def with_guess(self, field: str, reason: str, **change: Any) -> "GuessedColumn":
        """The same column with one more guess."""
        reasons = {**self.reasons, field: reason}
        return replace(self, source=self.source.but(**change), reasons=reasons)

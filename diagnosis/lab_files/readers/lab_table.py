"""The result of every reader: columns of numbers, with the lab's names."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class LabTable:
    """Columns that were sampled together.

    Attributes:
      title: file, and topic if the file has several, for messages.
      columns: values by name, (N,) each; NaN where the file has none.
      words: other text of the file on a column (the name of a joint), by name of the column.
      ros_units: the numbers are in rad, N m, m and s, as ROS requires (REP 103).
    """

    title: str
    columns: Mapping[str, Array]
    words: Mapping[str, str] = field(default_factory=dict)
    ros_units: bool = False

    @property
    def rows(self) -> int:
        """Number of samples."""
        return next((values.size for values in self.columns.values()), 0)


@dataclass(frozen=True, kw_only=True)
class LabFile:
    """One file of a lab.

    Attributes:
      tables: one, or one for each topic or length.
      scalars: single numbers, such as a sampling rate.
      notes: what was left out, and why.
    """

    path: Path
    tables: tuple[LabTable, ...]
    scalars: Mapping[str, float] = field(default_factory=dict)
    notes: tuple[str, ...] = ()

    @property
    def header(self) -> tuple[tuple[str, ...], ...]:
        """Names of all columns: files with the same header are of one kind."""
        return tuple(sorted(tuple(table.columns) for table in self.tables))


def unique_names(names: Iterable[str]) -> list[str]:
    """The names; repeated ones get a number: `torque`, `torque #2`."""
    seen: dict[str, int] = {}
    found = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        found.append(name if seen[name] == 1 else f"{name} #{seen[name]}")
    return found

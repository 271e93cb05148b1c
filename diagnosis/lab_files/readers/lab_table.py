"""What every reader returns: columns of numbers under the names that the lab gave them."""

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
      title: file, and topic where a file has several, as messages name it.
      columns: values by name, (N,) each; NaN where the file has none.
      words: what else the file says of a column (the name of a joint), by name of the column.
      ros_units: the numbers are in rad, N m, m and s, as ROS asks for (REP 103).
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
      scalars: single numbers beside the tables, such as a sampling rate.
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
    """The names, those that return with a number behind: `torque`, `torque #2`."""
    seen: dict[str, int] = {}
    found = []
    for name in names:
        seen[name] = seen.get(name, 0) + 1
        found.append(name if seen[name] == 1 else f"{name} #{seen[name]}")
    return found

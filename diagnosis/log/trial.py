"""A trial of a log: the inputs of the needle, and the readings of the sensors."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from diagnosis.criteria.log import SAME_STEP
from models.errors import NeedleError

Array = NDArray[np.float64]

BASE, TORQUE, TIP = "base_angle_deg", "base_torque_n_mm", "tip_angle_deg"
REQUIRED = ("time_s", BASE, "inserted_mm", "free_mm", "speed_mm_s")
SENSORS = (TORQUE, TIP)
OPTIONAL = (*SENSORS, "tip_torque_n_mm")
COLUMNS = (*REQUIRED, *OPTIONAL)


class UnusableLog(NeedleError):
    """A log that cannot be used; names file, line or column, what was expected and found, the fix."""


def sampled_at(time_s: Array, step_s: float) -> bool:
    """Whether samples are about so far apart, in the median."""
    return time_s.size < 2 or abs(float(np.median(np.diff(time_s))) / step_s - 1.0) <= SAME_STEP


@dataclass(frozen=True, kw_only=True, eq=False)
class FileRows:
    """The rows of a trial's file, whatever was done to their times and readings, (N,) each.

    Attributes:
      stamps_s: their time stamps in the file.
      taken_s: the times at which they were taken.
      errors_s: what these may be off by, by example, (K, N); None: they are exact.
    """

    stamps_s: Array
    taken_s: Array
    errors_s: Array | None = None


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One trial as the rig logged it: a table with the columns of the format, one row per sample.

    Attributes:
      name: name of the file.
      table: required columns, and the optional ones that the file has.
      rows: rows of the file, if its times are not those of the table; None: they are.
    """

    name: str
    table: pd.DataFrame
    rows: FileRows | None = None

    def __getitem__(self, column: str) -> Array:
        """A column, (N,); `base_angle_deg` is the reading of the encoder."""
        return self._columns[column]

    @property
    def file_rows(self) -> FileRows:
        """The rows of its file."""
        return self.rows or FileRows(stamps_s=self["time_s"], taken_s=self["time_s"])

    def has(self, sensor: str) -> bool:
        """Whether the trial has readings of this sensor."""
        return sensor in self._measured

    @property
    def tip_is_loaded(self) -> bool:
        """Whether a known torque acts at the tip, which may then turn by itself."""
        torque = "tip_torque_n_mm"
        return self.has(torque) and bool(np.nanmax(np.abs(self[torque])) > 0)

    @cached_property
    def _columns(self) -> dict[str, Array]:
        return {str(name): np.asarray(self.table[name], float) for name in self.table}

    @cached_property
    def _measured(self) -> frozenset[str]:
        return frozenset(name for name, values in self._columns.items() if not np.isnan(values).all())

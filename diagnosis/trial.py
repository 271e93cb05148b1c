"""A trial of a log: what was done to the needle, and what the sensors read."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import pandas as pd
from numpy.typing import NDArray

from models.errors import NeedleError
from sim.schedule import Schedule

Array = NDArray[np.float64]

REQUIRED = ("time_s", "base_angle_deg", "inserted_mm", "free_mm", "speed_mm_s")
SENSORS = ("base_torque_n_mm", "tip_angle_deg")
OPTIONAL = (*SENSORS, "tip_torque_n_mm")
COLUMNS = (*REQUIRED, *OPTIONAL)

_SAME_DEPTH_MM = 0.2


class UnusableLog(NeedleError):
    """A log that cannot be used: file, line or column, what was expected, the mend."""


@dataclass(frozen=True, kw_only=True)
class Trial:
    """One trial: a table with the columns of the format, one row a sample.

    Attributes:
      name: of the file.
      table: required columns, and the optional ones that the file has.
    """

    name: str
    table: pd.DataFrame

    def __getitem__(self, column: str) -> Array:
        return self._columns[column]

    def has(self, sensor: str) -> bool:
        """Whether the trial measured this at all."""
        return sensor in self._measured

    def schedule(self) -> Schedule:
        """What was done to the needle, as the rig measured it."""
        return self._schedule

    # A fit asks thousands of times for the same; the table never changes.
    @cached_property
    def _columns(self) -> dict[str, Array]:
        return {str(name): np.asarray(self.table[name], float) for name in self.table}

    @cached_property
    def _measured(self) -> frozenset[str]:
        return frozenset(name for name, values in self._columns.items() if not np.isnan(values).all())

    @cached_property
    def _schedule(self) -> Schedule:
        tip = np.nan_to_num(self["tip_torque_n_mm"]) if self.has("tip_torque_n_mm") else np.zeros(0)
        return Schedule(
            time_s=self["time_s"],
            drive=self["base_angle_deg"],
            free_mm=self["free_mm"],
            inserted_mm=_steadied(self["inserted_mm"]),
            speed_mm_s=self["speed_mm_s"],
            tip_torque_n_mm=tip,
        )


def _steadied(depth: Array) -> Array:
    """A depth that hardly changes is constant: what is left is the reading of the stage."""
    return np.full(depth.shape, np.median(depth)) if np.ptp(depth) < _SAME_DEPTH_MM else depth

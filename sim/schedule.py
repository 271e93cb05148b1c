"""The inputs of a run over time, sampled.

Between samples all inputs are linear. Lengths and speed are those of the shaft
relative to the tissue; `speed_mm_s` is positive into it.
"""

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from models.errors import InvalidValue
from sim.discretisation import Mesh

Array = NDArray[np.float64]

COLUMNS = ("drive", "free_mm", "inserted_mm", "speed_mm_s", "tip_torque_n_mm", "tissue_factor")
"""Inputs beside time."""

# Lengths that differ by less than this are the same length, mm.
LENGTH_TOLERANCE_MM = 1e-6


def mesh_for(free_mm: Array, inserted_mm: Array) -> Mesh:
    """Eulerian if the inserted length is constant and above 0, fed if the free length is instead.

    Args:
      free_mm, inserted_mm: lengths over time, (N,).
    """
    deeper = np.ptp(inserted_mm)
    if deeper <= LENGTH_TOLERANCE_MM and inserted_mm[0] > 0:
        return Mesh.EULERIAN
    return Mesh.FED if np.ptp(free_mm) < 0.5 * deeper else Mesh.LAGRANGIAN


@dataclass(frozen=True, kw_only=True, eq=False)
class Schedule:
    """Inputs at increasing times; every array has the shape of `time_s`, (N,).

    Attributes:
      time_s: strictly increasing.
      drive: base angle, deg, or base torque, N mm, depending on the drive.
      free_mm: from chuck to tissue.
      inserted_mm: in contact with tissue.
      speed_mm_s: axial, positive into the tissue.
      tip_torque_n_mm: known torque at the tip, positive resists positive rotation.
      tissue_factor: factor on the torque of tissue that varies in time; 1: as its law says.

    Raises:
      InvalidValue: names the column and the first offending row.
    """

    time_s: Array
    drive: Array
    free_mm: Array
    inserted_mm: Array
    speed_mm_s: Array
    tip_torque_n_mm: Array = field(default_factory=lambda: np.zeros(0))
    tissue_factor: Array = field(default_factory=lambda: np.zeros(0))

    def __post_init__(self) -> None:
        time = np.asarray(self.time_s, float)
        if self.tip_torque_n_mm.size == 0:
            object.__setattr__(self, "tip_torque_n_mm", np.zeros(time.shape))
        if self.tissue_factor.size == 0:
            object.__setattr__(self, "tissue_factor", np.ones(time.shape))
        if time.ndim != 1 or time.size < 2:
            raise InvalidValue("time_s", time.shape, "at least two samples in one dimension")
        columns = {name: np.asarray(getattr(self, name), float) for name in ("time_s", *COLUMNS)}
        for name, values in columns.items():
            object.__setattr__(self, name, values)
            if values.shape != time.shape:
                raise InvalidValue(name, values.shape, f"as many samples as time_s: {time.shape}")
        if not np.isfinite(list(columns.values())).all():
            raise _not_finite(columns)
        back = time[1:] <= time[:-1]
        if back.any():
            i = int(np.argmax(back))
            raise InvalidValue(
                f"time_s[{i + 1}]", float(time[i + 1]), f"a time after {time[i]}", "sort the samples"
            )
        for name in ("free_mm", "inserted_mm"):
            values = getattr(self, name)
            if values.min() < -LENGTH_TOLERANCE_MM:
                low = int(np.argmax(values < -LENGTH_TOLERANCE_MM))
                raise InvalidValue(f"{name}[{low}]", float(values[low]), "a length of at least 0 mm")

    @cached_property
    def _resampled(self) -> dict[float, "Schedule"]:
        """By step: the runs of a fit ask thousands of times for the same."""
        return {}

    @property
    def duration_s(self) -> float:
        """Time from the first sample to the last, s."""
        return float(self.time_s[-1] - self.time_s[0])

    @cached_property
    def longest_mm(self) -> float:
        """Largest length between chuck and tip in the schedule, mm."""
        return float((self.free_mm + self.inserted_mm).max())

    @cached_property
    def mesh(self) -> Mesh:
        """The mesh for these inputs."""
        return mesh_for(self.free_mm, self.inserted_mm)

    def rows(self, kept: NDArray[np.bool_]) -> "Schedule":
        """The inputs at some of their times, at least two."""
        return Schedule(**{name: getattr(self, name)[kept] for name in ("time_s", *COLUMNS)})

    def steps(self, step_s: float) -> int:
        """Number of equal steps, the last of which ends at or after the end."""
        return max(1, int(np.ceil(self.duration_s / step_s - 1e-9)))

    def at_steps(self, step_s: float) -> "Schedule":
        """The same inputs at the ends of equal steps, the last at or after the end."""
        if step_s not in self._resampled:
            self._resampled[step_s] = self._at_steps(step_s)
        return self._resampled[step_s]

    def _at_steps(self, step_s: float) -> "Schedule":
        time = self.time_s[0] + step_s * np.arange(self.steps(step_s) + 1)
        inputs = {name: np.interp(time, self.time_s, getattr(self, name)) for name in COLUMNS}
        return Schedule(time_s=time, **inputs)


def _not_finite(columns: dict[str, Array]) -> InvalidValue:
    """The error for the first number that is not finite."""
    name, values = next((n, v) for n, v in columns.items() if not np.isfinite(v).all())
    bad = int(np.argmin(np.isfinite(values)))
    return InvalidValue(f"{name}[{bad}]", float(values[bad]), "a finite number")

"""How a trial is driven: base angle, lengths, axial speed and torque at the tip."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

CONSTANT_LENGTH_MM = 1e-6
"""A length that changes by less is constant."""


@dataclass(frozen=True, kw_only=True)
class TrialMotion:
    """The inputs of a trial, (N,) each, on a time grid that is `per_sample` times finer than the log.

    Attributes:
      tip_torque_n_mm: known torque at the tip that resists the turn; None: none acts.
      lead: points of the grid that pass before the recording begins.
      trial: its number in the log, from 0.
    """

    dt_s: float
    per_sample: int
    base_deg: Array
    inserted_mm: Array
    free_mm: Array
    speed_mm_s: Array
    tip_torque_n_mm: Array | None = None
    lead: int = 0
    trial: int = 0

    @property
    def time_s(self) -> Array:
        """Times of the fine grid, s, (N,)."""
        return np.asarray(np.arange(self.base_deg.size) * self.dt_s)

    @property
    def recorded(self) -> slice:
        """The points of the fine grid that are samples of the log."""
        return slice(self.lead, None, self.per_sample)

    @property
    def growing(self) -> bool:
        """Whether the inserted length changes."""
        return bool(np.ptp(self.inserted_mm) > CONSTANT_LENGTH_MM)

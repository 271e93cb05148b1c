"""Duty-cycled spinning: a bevel tip that curves less (Minhas, Engh, Fenske and Riviere 2007).

A tip that spins while it is inserted moves straight; one that is held curves by 1/R. Each cycle
holds the tip at one roll and then spins it once around. If it spins for a share d of the time,
the mean curvature is

    (1 - d) / R    towards the held roll.

The law gives the roll of the tip; a tip controller turns the base accordingly.
"""

import math

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from models.needle import Positive
from models.record import Record

Array = NDArray[np.float64]

_TURN_DEG = 360.0


class DutyCycle(Record):
    """Roll over time: held, then once around, again and again."""

    duty: float = Field(ge=0, le=1)
    """Share of the time that the tip spins, d."""
    spin_deg_s: Positive = 360.0
    held_deg: float = 0.0

    @property
    def period_s(self) -> float:
        """Duration of one hold and one spin, s; infinite for a tip that never spins."""
        return _TURN_DEG / self.spin_deg_s / self.duty if self.duty > 0 else math.inf

    @property
    def curvature_share(self) -> float:
        """Curvature of the path / curvature of a tip that is held."""
        return 1.0 - self.duty

    def roll_deg(self, time_s: float) -> float:
        """Roll at a time after the start of a hold; it grows by a turn each cycle."""
        if self.duty == 0:
            return self.held_deg
        turns, phase = divmod(time_s / self.period_s, 1.0)
        spun = max(phase - (1.0 - self.duty), 0.0) / self.duty
        return self.held_deg + _TURN_DEG * (turns + spun)


def mean_pull(roll_rad: Array, inserted_mm: Array) -> complex:
    """Mean of exp(i roll) over the travel: its modulus is curvature times R, its argument the direction.

    Args:
      roll_rad, inserted_mm: (N,) each, over whole cycles.
    """
    pull = np.trapezoid(np.exp(1j * roll_rad), inserted_mm)
    return complex(pull / (inserted_mm[-1] - inserted_mm[0]))

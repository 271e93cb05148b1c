"""How the base turns by 90 deg in the quick turn, which the paper does not state.

It only says "quickly", "tuned to provide the fastest response without oscillating".
Two motions represent that:

    ramp     90 deg at a constant rate; in 0.3 s wherever this project has to choose
    servo    a critically damped servo of second order, 1 - (1 + t / T) exp(-t / T)
"""

from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

TURN_DEG = 90.0


class BaseTurnShape(StrEnum):
    """Shape of the base's turn to 90 deg."""

    RAMP = "ramp"
    SERVO = "servo"


@dataclass(frozen=True, kw_only=True)
class BaseTurn:
    """Base angle over time: shape, and its time (a ramp's duration, a servo's T), s."""

    shape: BaseTurnShape = BaseTurnShape.RAMP
    time_s: float = 0.3

    def angle_deg(self, time_s: Array) -> Array:
        """Base angle at times from the start of the turn, deg, (N,)."""
        share = time_s / self.time_s
        if self.shape is BaseTurnShape.RAMP:
            return np.asarray(TURN_DEG * np.clip(share, 0.0, 1.0), np.float64)
        return np.asarray(TURN_DEG * (1 - (1 + share) * np.exp(-share)), np.float64)

"""The lag of the shaft behind its base, in the modes of the base-driven needle.

theta(x, t) - base(t) = sum c_k(t) cos(w_k (l - x)) (models.modes), driven by the base's rate:
dc_k/dt = p_k c_k - a_k d base/dt. The tip is base + sum c_k.
"""

import math

import numpy as np
from numpy.typing import NDArray

from controllers.signals import Estimate
from models.modes import InsertedNeedle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0


class BaseModes:
    """Modes of the base-driven needle, from the modes and tip of an estimate.

    The lag theta - base is known at the tip, and its shape along the shaft follows from the
    torque; its modes are a projection of the modes of the estimate.
    """

    def __init__(self, held: InsertedNeedle, count: int, known: int) -> None:
        self.held = held
        self.poles = held.poles_rad_s(count)
        self.participation = held.participation(count)
        s = np.linspace(0.0, held.inserted_mm, 201)
        shapes = np.cos(np.outer(s, held.wavenumbers_per_mm(count)))
        k = np.arange(1, known + 1)
        past_tip = np.cos(np.outer(s, k * np.pi / held.inserted_mm)) - 1.0
        project = np.linalg.pinv(shapes)
        self._from_modes, self._from_tip = project @ past_tip, project @ np.ones(s.size)

    def lag_modes_rad(self, estimate: Estimate, base_deg: float) -> Array:
        """c_k, rad, from the estimated modes and tip."""
        modes = self._from_modes @ (estimate.modes_deg * _RAD)
        lag: Array = modes + self._from_tip * (estimate.tip_deg - base_deg) * _RAD
        return lag

"""Dry friction of a bearing that turns with a shaft: an elastic-plastic element (stop operator).

    torque = level * z / z_y,    z <- clamp(z + change of the angle, -z_y, z_y)

It sticks until the shaft has turned by the presliding angle z_y, then slides at its level. z depends
only on the motion of the shaft, so no needle has to be simulated for it.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from sim.discretisation import PRESLIDING_DEG

Array = NDArray[np.float64]


def bearing_torque_n_mm(
    shaft_deg: Array, level_n_mm: float, presliding_deg: float = PRESLIDING_DEG
) -> Array:
    """Torque of the bearing on the shaft, N mm, (N,); 0 at the start."""
    return level_n_mm / presliding_deg * stopped_at(shaft_deg, presliding_deg)


@njit(cache=True)
def stopped_at(angle: Array, limit: float) -> Array:
    """z at each sample of an angle that is linear between samples, (N,)."""
    z = np.zeros(angle.size)
    for i in range(1, angle.size):
        z[i] = min(max(z[i - 1] + angle[i] - angle[i - 1], -limit), limit)
    return z

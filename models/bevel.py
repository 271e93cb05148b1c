"""The path of a bevel tip: constant curvature in the direction in which the bevel pulls.

With unit tangent t and a frame n, b that is carried along without turning about t, a
tip of radius of curvature R at roll theta moves as (Webster et al. 2006; the paper's
Section V uses R = 61 mm for its prebent tip)

    dp/ds = t,    dt/ds = (cos theta n + sin theta b) / R.

At constant roll the tip moves along a circle. Every step is an arc of it: exact for any step
length, and the frame stays orthonormal.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

from models.errors import InvalidValue

Array = NDArray[np.float64]

PREBENT_RADIUS_MM = 61.0
"""Section V: radius of curvature of the prebent needle."""


class BevelTip:
    """The pose of a tip; x along the first insertion, z out of the first plane of curvature.

    Args:
      radius_mm: radius of curvature.
      position_mm: where the tip starts, (3,).

    Raises:
      InvalidValue: the radius is not positive.
    """

    def __init__(self, radius_mm: float = PREBENT_RADIUS_MM, position_mm: ArrayLike = (0, 0, 0)) -> None:
        if not (np.isfinite(radius_mm) and radius_mm > 0):
            raise InvalidValue("radius_mm", radius_mm, "a finite length above 0 mm")
        self.radius_mm = radius_mm
        self.position_mm = np.array(position_mm, float)
        self.frame = np.eye(3)  # columns: t, n, b

    def advance(self, length_mm: float, roll_rad: float) -> None:
        """Move by a length with the tip at a roll; negative lengths retrace the arc."""
        angle = length_mm / self.radius_mm
        ahead, (toward, onward) = self.tangent, self.pointing(roll_rad)
        rise = 2.0 * math.sin(0.5 * angle) ** 2  # 1 - cos, without cancellation
        self.position_mm = self.position_mm + self.radius_mm * (math.sin(angle) * ahead + rise * toward)
        turned = math.cos(angle) * toward - math.sin(angle) * ahead
        self.frame[:, 0] = math.cos(angle) * ahead + math.sin(angle) * toward
        self.frame[:, 1] = math.cos(roll_rad) * turned - math.sin(roll_rad) * onward
        self.frame[:, 2] = math.sin(roll_rad) * turned + math.cos(roll_rad) * onward

    @property
    def tangent(self) -> Array:
        """Direction of travel, (3,)."""
        direction: Array = self.frame[:, 0].copy()
        return direction

    def pointing(self, roll_rad: float) -> tuple[Array, Array]:
        """Direction in which the bevel pulls at a roll, and its derivative with the roll, (3,) each."""
        _, n, b = self.frame.T
        toward = math.cos(roll_rad) * n + math.sin(roll_rad) * b
        onward = -math.sin(roll_rad) * n + math.cos(roll_rad) * b
        return toward, onward


def path_mm(arc_mm: ArrayLike, roll_rad: ArrayLike, *, radius_mm: float = PREBENT_RADIUS_MM) -> Array:
    """The path of a tip over arc lengths and rolls, (N,) each: positions, (N, 3)."""
    arc, roll = np.asarray(arc_mm, float), np.asarray(roll_rad, float)
    tip, places = BevelTip(radius_mm), np.zeros((arc.size, 3))
    for i in range(1, arc.size):
        tip.advance(arc[i] - arc[i - 1], 0.5 * (roll[i] + roll[i - 1]))
        places[i] = tip.position_mm
    return places

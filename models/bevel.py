"""Where a bevel tip goes: constant curvature in the direction that the tip points.

With unit tangent t and a frame n, b that is carried along without turning about t, a
tip of radius of curvature R at roll theta moves as (Webster et al. 2006; the paper's
Section V uses R = 61 mm for its prebent tip)

    dp/ds = t,    dt/ds = (cos theta n + sin theta b) / R.

Each step is an exact rotation, so the frame stays orthonormal.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from models.errors import InvalidValue

Array = NDArray[np.float64]

PREBENT_RADIUS_MM = 61.0
"""Section V: radius of curvature of the prebent needle."""


class BevelTip:
    """A tip on its way; x along the first insertion, z out of the first plane of curvature.

    Args:
      radius_mm: of curvature.
      position_mm: where the tip starts, (3,).

    Raises:
      InvalidValue: the radius is not positive.
    """

    def __init__(self, radius_mm: float = PREBENT_RADIUS_MM, position_mm: ArrayLike = (0, 0, 0)) -> None:
        if not (np.isfinite(radius_mm) and radius_mm > 0):
            raise InvalidValue("radius_mm", radius_mm, "a finite length above 0 mm")
        self.radius_mm = radius_mm
        self.position_mm = np.array(position_mm, float)
        self.frame = Rotation.identity()  # columns: t, n, b

    def advance(self, length_mm: float, roll_rad: float) -> None:
        """Move by a length with the tip at a roll; negative lengths retrace the arc."""
        half = self._turned(0.5 * length_mm, roll_rad)
        self.position_mm = self.position_mm + length_mm * self._chord(length_mm) * half.as_matrix()[:, 0]
        self.frame = self._turned(length_mm, roll_rad)

    def _turned(self, length_mm: float, roll_rad: float) -> Rotation:
        axis = np.array([0.0, -np.sin(roll_rad), np.cos(roll_rad)])
        return self.frame * Rotation.from_rotvec(axis * length_mm / self.radius_mm)

    def _chord(self, length_mm: float) -> float:
        """Chord over arc: the step along the middle direction that ends on the circle."""
        return float(np.sinc(0.5 * length_mm / self.radius_mm / np.pi))

    @property
    def tangent(self) -> Array:
        """Direction of travel, (3,)."""
        direction: Array = self.frame.as_matrix()[:, 0]
        return direction

    def pointing(self, roll_rad: float) -> tuple[Array, Array]:
        """Where the bevel pulls at a roll, and the direction in which more roll moves it."""
        _, n, b = self.frame.as_matrix().T
        toward = np.cos(roll_rad) * n + np.sin(roll_rad) * b
        onward = -np.sin(roll_rad) * n + np.cos(roll_rad) * b
        return toward, onward


def path_mm(arc_mm: ArrayLike, roll_rad: ArrayLike, *, radius_mm: float = PREBENT_RADIUS_MM) -> Array:
    """The path of a tip over arc lengths and rolls, (N,) each: positions, (N, 3)."""
    arc, roll = np.asarray(arc_mm, float), np.asarray(roll_rad, float)
    tip, places = BevelTip(radius_mm), np.zeros((arc.size, 3))
    for i in range(1, arc.size):
        tip.advance(arc[i] - arc[i - 1], 0.5 * (roll[i] + roll[i - 1]))
        places[i] = tip.position_mm
    return places

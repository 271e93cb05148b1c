"""Position and direction of a bevel tip, and how their errors grow during insertion.

The pose is that of models.bevel: position p and the frame F = (t, n, b) that is carried along
without turning about t. The error state (true minus estimated) turns the frame from the left,

    p_true = p + dp,    F_true = exp(dphi x) F,    roll_true = theta + dtheta

and over a travel s, whose chord is c, with curvature k = 1/R and the bevel's pull d

    dp' = dp + dphi x c + (k s^2 / 2) e dtheta
    dphi' = dphi - k s d dtheta,                 e = t x d

exact in dphi, and to first order of the angle k s of one step in dtheta.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.spatial.transform import Rotation

from models.bevel import BevelTip

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PoseJacobian:
    """Errors after a step in terms of errors before it.

    Attributes:
      direction_on_position: (3, 3).
      roll_on_position, roll_on_direction: (3,) each, mm and rad per rad of roll.
    """

    direction_on_position: Array
    roll_on_position: Array
    roll_on_direction: Array


class TipPose:
    """The estimated pose of the tip.

    Args:
      radius_mm: radius of curvature.
      position_mm: at the start, (3,).
    """

    def __init__(self, radius_mm: float, position_mm: ArrayLike = (0.0, 0.0, 0.0)) -> None:
        self._tip = BevelTip(radius_mm, position_mm)

    @property
    def position_mm(self) -> Array:
        """Position of the tip, mm, (3,)."""
        return self._tip.position_mm

    @property
    def frame(self) -> Array:
        """Columns t, n and b, (3, 3)."""
        return self._tip.frame

    def advance(self, travel_mm: float, roll_rad: float) -> PoseJacobian:
        """Move the tip, and return how the step changes its errors."""
        start = self._tip.position_mm
        toward, onward = self._tip.pointing(roll_rad)
        self._tip.advance(travel_mm, roll_rad)
        angle = travel_mm / self._tip.radius_mm
        return PoseJacobian(
            direction_on_position=-cross_matrix(self._tip.position_mm - start),
            roll_on_position=0.5 * travel_mm * angle * onward,
            roll_on_direction=-angle * toward,
        )

    def correct(self, position_mm: Array, direction_rad: Array) -> None:
        """Add an estimated error: position, mm, and direction, rad, (3,) each."""
        self._tip.position_mm = self._tip.position_mm + position_mm
        self._tip.frame = Rotation.from_rotvec(direction_rad).as_matrix() @ self._tip.frame

    def errors_to(self, position_mm: Array, frame: Array) -> tuple[Array, Array]:
        """Error state towards a true pose: position, mm, and direction, rad, (3,) each."""
        turned = Rotation.from_matrix(frame @ self._tip.frame.T).as_rotvec()
        return position_mm - self._tip.position_mm, turned


def cross_matrix(vector: Array) -> Array:
    """The matrix that takes w to vector x w, (3, 3)."""
    x, y, z = vector
    return np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])

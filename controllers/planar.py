"""Keeping the tip in a plane by rolling it: after Kallem and Cowan (2009), ref. [8].

With height z over the plane, direction of travel t, the bevel's pull d and e = t x d,
per length travelled (curvature k = 1/R)

    z' = t_z,    z'' = k d_z,    z''' = k (theta' e_z - k t_z)

so the roll rate  theta' = ((-k0 z - k1 z' - k2 z'') / k + k t_z) / e_z  makes z a
linear third-order system with all poles at -1 / settling length. The controller
knows z and t from images, and d only through the estimated roll.
"""

import math

import numpy as np
from numpy.typing import NDArray

from models.errors import InvalidValue

Array = NDArray[np.float64]

_LEAST_FACING = 0.3  # of e_z: beyond it the plane cannot be steered by roll


class PlanarController:
    """Roll rate that brings the tip into the plane z = 0.

    Args:
      radius_mm: of curvature of the needle.
      settling_mm: length in which errors fall by e.
      most_roll_rad_per_mm: limit on the roll rate.

    Raises:
      InvalidValue: one of them is not positive.
    """

    def __init__(
        self, *, radius_mm: float, settling_mm: float = 10.0, most_roll_rad_per_mm: float = 0.5
    ) -> None:
        for name, value in (
            ("radius_mm", radius_mm),
            ("settling_mm", settling_mm),
            ("most_roll_rad_per_mm", most_roll_rad_per_mm),
        ):
            if not (math.isfinite(value) and value > 0):
                raise InvalidValue(name, value, "a finite number above 0")
        self.curvature = 1.0 / radius_mm
        p = 1.0 / settling_mm
        self.gains = np.array([p**3, 3 * p**2, 3 * p])
        self.most = most_roll_rad_per_mm

    def roll_rate(self, height_mm: float, tangent: Array, pull: Array, onward: Array) -> float:
        """Roll per length, rad/mm.

        Args:
          height_mm: z.
          tangent, pull, onward: t, d and e with the estimated roll, (3,) each.
        """
        wanted = -float(self.gains @ [height_mm, tangent[2], self.curvature * pull[2]])
        facing = math.copysign(max(abs(onward[2]), _LEAST_FACING), onward[2] or 1.0)
        rate = (wanted / self.curvature + self.curvature * tangent[2]) / facing
        return float(min(max(rate, -self.most), self.most))

"""Keeping the tip in a plane by rolling it: after Kallem and Cowan (2009), ref. [8].

With height z over the plane, direction of travel t, the bevel's pull d and e = t x d,
per length travelled (curvature k = 1/R, roll theta)

    z' = t_z,    t_z' = k d_z,    d_z' = theta' e_z - k t_z

In pitch beta and roll gamma against the plane t_z = sin beta, d_z = cos beta sin gamma
and e_z = cos beta cos gamma, so that beta' = k sin gamma and gamma' = theta' - k tan beta
cos gamma: the three-state system of ref. [8]. The roll rate

    theta' = ((-k0 z - k1 t_z - k2 k d_z) / k + k t_z) / e_z

makes z a linear third-order system with all poles at -1 / settling length (feedback
linearisation). The insertion speed cancels: a person may choose it freely.
"""

import math
from dataclasses import dataclass

import numpy as np

from models.errors import InvalidValue

_LEAST_FACING = 0.3  # of e_z: beyond it the plane cannot be steered by roll


@dataclass(frozen=True, slots=True)
class PlanarState:
    """Where the tip is and points, relative to the plane.

    Attributes:
      height_mm: height z over the plane.
      slope, pull, facing: t_z, d_z and e_z; together a unit vector.
    """

    height_mm: float
    slope: float
    pull: float
    facing: float


class PlanarController:
    """Roll rate that brings the tip into the plane z = 0.

    Args:
      radius_mm: radius of curvature of the needle.
      settling_mm: travel over which errors fall by a factor e.
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

    def roll_rate(self, tip: PlanarState) -> float:
        """Roll per travel, rad/mm, for a known state of the tip."""
        wanted = -float(self.gains @ [tip.height_mm, tip.slope, self.curvature * tip.pull])
        facing = math.copysign(max(abs(tip.facing), _LEAST_FACING), tip.facing or 1.0)
        rate = (wanted / self.curvature + self.curvature * tip.slope) / facing
        return float(min(max(rate, -self.most), self.most))

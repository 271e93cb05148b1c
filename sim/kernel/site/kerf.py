"""The kerf of the tip (models.kerf): its torque against the angle from it, in an implicit stage.

    phi + m shape(phi) = phi* + g omega,    m = g |v| / travel
    torque = k shape(phi)

and k is the stiffness at phi = 0. The shape is a sine, or tanh(phi / a) a; where the torque is of the
latter, what fades is phi itself. The energy is the integral of the torque over phi.
"""

import math
from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded

_ITERATIONS = 4  # of Newton's method for a sine: m is some thousandths, and each squares what is missed


class InKerf(NamedTuple):
    """The angle of the tip from its kerf after a stage, and what it does there."""

    phi: float  # rad
    torque: float  # N m
    slope: float  # of the torque against the rate of the tip, N m s / rad


@embedded
def in_kerf(omega: float, row: Array, before: float, g: float, axial: float) -> InKerf:
    """The state after a stage.

    Args:
      omega: rate of the tip, rad/s.
      row: of the law table.
      before: the angle before the stage, rad.
      g: length of the stage, s.
      axial: axial speed over the radius, rad/s.
    """
    k, a = row[memory_map.L_STIFFNESS], row[memory_map.L_KERF_ANGLE]
    cut = axial if axial > 0.0 else -axial * row[memory_map.L_BACKWARDS]
    m, target = g * cut * row[memory_map.L_KERF], before + g * omega
    if a > 0.0:
        phi = target / (1.0 + m)
        share = math.tanh(phi / a)
        return InKerf(phi, k * a * share, k * (1.0 - share * share) * g / (1.0 + m))
    phi = target
    for _ in range(_ITERATIONS):
        phi -= (phi + m * math.sin(phi) - target) / (1.0 + m * math.cos(phi))
    return InKerf(phi, k * math.sin(phi), k * math.cos(phi) * g / (1.0 + m * math.cos(phi)))


@embedded
def kerf_energy(phi: float, row: Array) -> float:
    """Energy at an angle, J: of log cosh without what overflows."""
    k, a = row[memory_map.L_STIFFNESS], row[memory_map.L_KERF_ANGLE]
    if a == 0.0:
        return k * (1.0 - math.cos(phi))
    u = abs(phi) / a
    return k * a * a * (u + math.log1p(math.exp(-2.0 * u)) - math.log(2.0))

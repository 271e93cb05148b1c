"""What acts on a piece of shaft: the parameters of all laws, and the torque of the interface.

Dry friction is elastic-plastic: a presliding angle z follows the slip up to +-limit, the torque is
level z / limit. If the level is shared with the axial motion, z is a vector (turning angle, axial
travel / radius), returned radially to a disc. Viscous torque is beta w |w|^(exponent - 1).

Some parameters belong to effects that the diagnosis does not model: `validation.rig.unmodelled`.
Units: N, mm, s, rad. Every law returns its torque and the slopes that Newton's method needs.
"""

import math
from typing import NamedTuple

from numba import njit

SMALLEST_RATE = 1e-6
"""The power law is linear below this slip rate, rad/s."""


class LawParameters(NamedTuple):
    """All parameters of a rig, with the values that switch each effect off."""

    rigidity: float
    damping: float
    radius: float
    limit: float = math.radians(0.1)
    exponent: float = 1.0
    ratio: float = 1.0
    boundary: float = 0.5
    gradient: float = 0.0
    """Damping is 1 - gradient at the entry, 1 + gradient at the tip, times its mean."""
    worn_share: float = 0.0
    worn_angle: float = 1.0
    """Damping loses that share as the slip travels that angle (e-fold)."""
    coulomb: float = 0.0
    asymmetry: float = 0.0
    """Dry level is 1 + asymmetry for positive slip, 1 - asymmetry for negative."""
    kinetic: float = 0.0
    static: float = 0.0
    stribeck: float = 1.0
    ageing: float = 0.0
    ageing_time: float = 1.0
    ageing_angle: float = 1.0
    """Dry level grows by ageing log(1 + age / ageing_time); slip by ageing_angle renews contact."""
    shared: float = 0.0
    compliance: float = 0.0
    retardation: float = 0.0
    entry: float = 0.0
    sheath: float = 0.0
    load: float = 0.0
    half_gap: float = 0.0
    base_compliance: float = 0.0
    hardening: float = 0.0
    """Shaft torque is rigidity strain (1 + hardening strain^2), strain in rad/mm."""
    grip: float = math.inf
    """The chuck slips at this torque."""
    tip_drag: float = 0.0
    curvature: float = 0.0
    phase: float = 0.0


@njit(cache=True)
def viscous(exponent: float, damping: float, rate: float) -> tuple[float, float]:
    """Torque per mm and its slope with the slip rate."""
    if exponent == 1.0:
        return damping * rate, damping
    size = rate * rate + SMALLEST_RATE * SMALLEST_RATE
    secant = damping * size ** ((exponent - 1.0) / 2.0)
    return secant * rate, secant * (exponent * rate * rate + SMALLEST_RATE**2) / size


@njit(cache=True)
def preslide(limit: float, before: float, travel: float) -> tuple[float, float]:
    """Presliding after that travel, and its slope with the travel."""
    after = before + travel
    if after >= limit:
        return limit, 0.0
    if after <= -limit:
        return -limit, 0.0
    return after, 1.0


@njit(cache=True)
def preslide_shared(limit: float, turning: float, axial: float) -> tuple[float, float, float]:
    """Both components returned to the disc, and the slope of the first with its travel."""
    size = math.sqrt(turning * turning + axial * axial)
    if size <= limit:
        return turning, axial, 1.0
    return turning * limit / size, axial * limit / size, limit * axial * axial / size**3


@njit(cache=True)
def dry_level(law: LawParameters, age: float, rate: float) -> tuple[float, float]:
    """Level of the dry friction that turning alone feels, and its slope with the slip rate."""
    level = law.coulomb + law.kinetic
    if law.ageing > 0.0:
        level += law.ageing * math.log1p(age / law.ageing_time)
    if law.static == law.kinetic:
        return level, 0.0
    relative = rate / law.stribeck
    excess = (law.static - law.kinetic) * math.exp(-relative * relative)
    return level + excess, -2.0 * relative / law.stribeck * excess


@njit(cache=True)
def dry(
    law: LawParameters, age: float, before: float, rate: float, travel: float
) -> tuple[float, float, float]:
    """Dry torque per mm with the level at that rate, its slopes with rate and with travel."""
    level, fall = dry_level(law, age, rate)
    if level == 0.0:
        return 0.0, 0.0, 0.0
    z, gain = preslide(law.limit, before, travel)
    side = 1.0 + math.copysign(law.asymmetry, z)
    if law.asymmetry < 0.0:
        side = 1.0 - math.copysign(law.asymmetry, z)
    share = z / law.limit * side
    return level * share, fall * share, level * gain / law.limit * side


@njit(cache=True)
def interface(
    law: LawParameters,
    damping: float,
    before: tuple[float, float, float, float],
    slip: tuple[float, float, float],
    level_rate: float,
) -> tuple[float, float, float]:
    """Torque per mm and its slopes with the slip rate and the slip.

    Args:
      before: presliding, its turning and axial parts of shared friction, age.
      slip: rate, travel within the step, axial travel over radius.
      level_rate: where the dry level is taken; if not at the slip rate, its slope does not count.
    """
    rate, travel, axial = slip
    torque, per_rate = viscous(law.exponent, damping, rate)
    more, more_per_rate, per_travel = dry(law, before[3], before[0], level_rate, travel)
    if level_rate != rate:
        more_per_rate = 0.0
    if law.shared > 0.0:
        z, _, gain = preslide_shared(law.limit, before[1] + travel, before[2] + axial)
        more += law.shared * z / law.limit
        per_travel += law.shared * gain / law.limit
    return torque + more, per_rate + more_per_rate, per_travel

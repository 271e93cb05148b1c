"""The torque of the interface on a piece of shaft.

Dry friction is elastic-plastic: a presliding angle z follows the slip up to +-limit, the torque is
level z / limit. If the level is shared with the axial motion, z is a vector (turning angle, axial
travel / radius), returned radially to a disc. Viscous torque is beta w |w|^(exponent - 1), or
beta w / (1 + |w| / saturation).

Units: N, mm, s, rad. Every law returns its torque and the slopes that Newton's method needs.
"""

import math

from numba import njit

from validation.rig.laws.parameters import REFERENCE_DEPTH_MM, LawParameters

SMALLEST_RATE = 1e-6
"""The power law is linear below this slip rate, rad/s."""


@njit(cache=True)
def viscous(exponent: float, damping: float, rate: float) -> tuple[float, float]:
    """Torque per mm and its slope with the slip rate."""
    if exponent == 1.0:
        return damping * rate, damping
    size = rate * rate + SMALLEST_RATE * SMALLEST_RATE
    secant = damping * size ** ((exponent - 1.0) / 2.0)
    return secant * rate, secant * (exponent * rate * rate + SMALLEST_RATE**2) / size


@njit(cache=True)
def saturating(saturation: float, damping: float, rate: float) -> tuple[float, float]:
    """Viscous torque per mm that tends to damping * saturation, and its slope with the slip rate."""
    share = 1.0 / (1.0 + abs(rate) / saturation)
    return damping * rate * share, damping * share * share


@njit(cache=True)
def damping_share(law: LawParameters, worn: float, time: float) -> float:
    """Share of the damping that is left after that travelled slip, rad, and that time, s."""
    share = 1.0
    if law.worn_share > 0.0:
        share = 1.0 - law.worn_share * (1.0 - math.exp(-worn / law.worn_angle))
    if law.decay_share > 0.0:
        share *= 1.0 - law.decay_share * (1.0 - math.exp(-time / law.decay_time))
    return share


@njit(cache=True)
def dry_share(law: LawParameters, depth: float, speed: float) -> float:
    """Dry level at that depth, mm, and axial speed, mm/s / level at the reference depth and at rest."""
    share = 1.0
    if law.pressing > 0.0:
        share = (depth / REFERENCE_DEPTH_MM) ** law.pressing
    if law.relief_speed < math.inf:
        share *= math.exp(-abs(speed) / law.relief_speed)
    return share


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
    """Level of the dry friction on turning alone, and its slope with the slip rate."""
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
    level_share: float,
) -> tuple[float, float, float]:
    """Torque per mm and its slopes with the slip rate and the slip.

    Args:
      before: presliding, turning and axial presliding of shared friction, age.
      slip: rate, travel within the step, axial travel / radius.
      level_rate: rate at which the dry level is taken; unless it is the slip rate, its slope is ignored.
      level_share: share of the dry level, as `dry_share`.
    """
    rate, travel, axial = slip
    torque, per_rate = viscous(law.exponent, damping, rate)
    if law.saturation < math.inf:
        torque, per_rate = saturating(law.saturation, damping, rate)
    more, more_per_rate, per_travel = dry(law, before[3], before[0], level_rate, travel)
    more *= level_share
    per_travel *= level_share
    more_per_rate *= level_share
    if level_rate != rate:
        more_per_rate = 0.0
    if law.shared > 0.0:
        z, _, gain = preslide_shared(law.limit, before[1] + travel, before[2] + axial)
        more += law.shared * z / law.limit
        per_travel += law.shared * gain / law.limit
    return torque + more, per_rate + more_per_rate, per_travel

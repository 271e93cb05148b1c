"""The tissue at the shaft: how far it twists under the torque of the interface.

Kelvin and Voigt, with compliance c, retardation time r and hardening h:

    twist + h twist^3 + r d(twist)/dt = c torque

Its stiffness 1/c may change with time and with depth.
"""

import math

from numba import njit

from validation.rig.laws.parameters import REFERENCE_DEPTH_MM, LawParameters


@njit(cache=True)
def tissue_compliance(law: LawParameters, time: float, depth: float) -> float:
    """Twist per torque per mm at rest, rad mm / (N mm), at that time, s, and depth, mm."""
    stiffness = 1.0 + law.stiffening * depth / REFERENCE_DEPTH_MM
    if law.softened_share > 0.0:
        stiffness *= 1.0 - law.softened_share * (1.0 - math.exp(-time / law.softening_time))
    return law.compliance / stiffness


@njit(cache=True)
def hardening_twist(hardening: float, retarded: float, forced: float) -> float:
    """The twist with retarded twist + hardening twist^3 = forced, by Newton's method."""
    twist = forced / retarded
    if hardening == 0.0:
        return twist
    for _ in range(60):
        excess = retarded * twist + hardening * twist**3 - forced
        change = excess / (retarded + 3.0 * hardening * twist * twist)
        twist -= change
        if abs(change) < 1e-12:
            break
    return twist

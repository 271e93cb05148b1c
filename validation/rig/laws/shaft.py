"""The torques of the shaft's links, and of the chuck, which is a spring with play that may slip.

A link is a spring, which may harden with the strain. Beyond a yield torque it takes a set p, linear
kinematic hardening: with stiffness k, |k (twist - p) - slope k p| never exceeds the yield torque.
A soft chuck turns by soft_play T / (soft_torque + |T|) in addition to T / stiffness.
"""

import math

from numba import njit

from validation.rig.laws.parameters import LawParameters
from validation.rig.mesh import CellChain
from validation.rig.state import CHUCK, RigState


@njit(cache=True)
def chuck_torque(
    law: LawParameters, chain: CellChain, state: RigState, base: float, first: float
) -> tuple[float, float, float]:
    """Torque of the drive on the needle, its slope with the stretch, and how far the chuck slips.

    Args:
      base, first: angles of the drive shaft and of the first node, rad.
    """
    stiffness = 1.0 / (1.0 / chain.link[0] + law.base_compliance)
    stretch = base - state.lumped[CHUCK] - first
    elastic = stretch - min(max(stretch, -law.half_gap), law.half_gap)
    torque, slope = _spring(law, stiffness, chain.link_mm[0], elastic, state.set_twist[0])
    if law.soft_play > 0.0:
        torque, slope = soft_spring(stiffness, law.soft_play, law.soft_torque, elastic)
    if abs(torque) > law.grip:
        held = math.copysign(law.grip, torque)
        return held, 0.0, (torque - held) / stiffness
    return torque, slope if abs(stretch) >= law.half_gap else 0.0, 0.0


@njit(cache=True)
def link_torque(
    law: LawParameters, chain: CellChain, state: RigState, link: int, twist: float
) -> tuple[float, float]:
    """Torque of a link at that twist, rad, and its slope."""
    return _spring(law, chain.link[link], chain.link_mm[link], twist, state.set_twist[link])


@njit(cache=True)
def set_growth(law: LawParameters, stiffness: float, twist: float, set_twist: float) -> float:
    """Growth of the permanent set of a link at that twist, rad."""
    driving = stiffness * (twist - (1.0 + law.yield_slope) * set_twist)
    excess = abs(driving) - law.yield_torque
    if excess <= 0.0:
        return 0.0
    return math.copysign(excess, driving) / (stiffness * (1.0 + law.yield_slope))


@njit(cache=True)
def soft_spring(stiffness: float, play: float, torque: float, stretch: float) -> tuple[float, float]:
    """Torque T with T / stiffness + play T / (torque + |T|) = stretch, and its slope."""
    size = abs(stretch)
    linear = torque / stiffness + play - size
    found = 0.5 * stiffness * (math.sqrt(linear * linear + 4.0 * size * torque / stiffness) - linear)
    slope = 1.0 / (1.0 / stiffness + play * torque / (torque + found) ** 2)
    return math.copysign(found, stretch), slope


@njit(cache=True)
def _spring(
    law: LawParameters, stiffness: float, length: float, twist: float, set_twist: float
) -> tuple[float, float]:
    growth = set_growth(law, stiffness, twist, set_twist)
    if growth != 0.0:
        share = law.yield_slope / (1.0 + law.yield_slope)
        return stiffness * (twist - set_twist - growth), stiffness * share
    elastic = twist - set_twist
    strain = elastic / length
    more = law.hardening * strain * strain
    return stiffness * elastic * (1.0 + more), stiffness * (1.0 + 3.0 * more)

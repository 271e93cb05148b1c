"""The parameters of all laws of the rig, with the values that switch each of them off.

Some belong to effects that the diagnosis does not model: `validation.rig.unmodelled`.
Units: N, mm, s, rad.
"""

import math
from typing import NamedTuple

REFERENCE_DEPTH_MM = 100.0
"""Where a law that changes with depth is as stated."""


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
    decay_share: float = 0.0
    decay_time: float = 1.0
    """Damping loses that share as time passes (e-fold)."""
    saturation: float = math.inf
    """Viscous torque tends to damping * that rate."""
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
    pressing: float = 0.0
    """Dry level is proportional to depth^pressing, and as stated at `REFERENCE_DEPTH_MM`."""
    relief_speed: float = math.inf
    """Dry level falls with the axial speed (e-fold)."""
    shared: float = 0.0
    compliance: float = 0.0
    retardation: float = 0.0
    softened_share: float = 0.0
    softening_time: float = 1.0
    """The tissue's stiffness loses that share as time passes (e-fold)."""
    stiffening: float = 0.0
    """The tissue's stiffness is 1 + stiffening as high at `REFERENCE_DEPTH_MM` as at the entry."""
    tissue_hardening: float = 0.0
    """The tissue's elastic torque is stiffness twist (1 + hardening twist^2), twist in rad."""
    entry: float = 0.0
    sheath: float = 0.0
    load: float = 0.0
    half_gap: float = 0.0
    base_compliance: float = 0.0
    hardening: float = 0.0
    """Shaft torque is rigidity strain (1 + hardening strain^2), strain in rad/mm."""
    yield_torque: float = math.inf
    yield_slope: float = 1.0
    """Beyond that torque the shaft takes a set, whose back torque has this share of its stiffness."""
    grip: float = math.inf
    """The chuck slips at this torque."""
    soft_play: float = 0.0
    soft_torque: float = 1.0
    """The chuck loses soft_play torque / (soft_torque + |torque|), rad."""
    tip_drag: float = 0.0
    tip_dry: float = 0.0
    fibre: float = 0.0
    fibre_phase: float = 0.0
    """Torque at the tip of fibre sin(2 (angle - fibre_phase))."""
    curvature: float = 0.0
    phase: float = 0.0

"""How strong effects may be, and the draw of what else belongs to them.

A family of one effect is a range of its strength and, per draw, a map from strength to parameters;
everything but the strength (signs, shapes, phases) is drawn beforehand. More strength, more gap.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from validation.logs.profiles import log_uniform
from validation.rig.rig import Rig

TWO_SIDED = {
    "layered_tissue",
    "needle_curvature",
    "stiffness_error",
    "damping_error",
    "tip_angle_bias",
    "tip_angle_scale",
    "torque_bias",
}
"""Strengths below 0 mean the other sign."""

Draw = np.random.Generator
ByStrength = Callable[[float], dict[str, float]]


@dataclass(frozen=True, kw_only=True)
class Family:
    """Smallest and largest strength, and the draw of the rest."""

    low: float
    high: float
    draw: Callable[[Draw], ByStrength]


def _only(name: str) -> Callable[[Draw], ByStrength]:
    return lambda rng: lambda strength: {name: strength}


def _inverse(name: str) -> Callable[[Draw], ByStrength]:
    return lambda rng: lambda strength: {name: 1 / strength}


def _signed(name: str) -> Callable[[Draw], ByStrength]:
    def draw(rng: Draw) -> ByStrength:
        sign = rng.choice([-1.0, 1.0])
        return lambda strength: {name: sign * strength}

    return draw


def _factor(name: str) -> Callable[[Draw], ByStrength]:
    """Strength is the size of the logarithm."""

    def draw(rng: Draw) -> ByStrength:
        sign = rng.choice([-1.0, 1.0])
        return lambda strength: {name: float(np.exp(sign * strength))}

    return draw


def _with(name: str, **others: tuple[float, float]) -> Callable[[Draw], ByStrength]:
    """Others are uniform in their ranges."""

    def draw(rng: Draw) -> ByStrength:
        drawn = {other: rng.uniform(*ends) for other, ends in others.items()}
        return lambda strength: {name: strength, **drawn}

    return draw


def _stiction(rng: Draw) -> ByStrength:
    """Peaks that fall off no faster than about the viscous torque rises: slip stays defined."""
    peak, stribeck = rng.uniform(1.5, 4.0), log_uniform(rng, 0.15, 2.0)
    steepest = 0.015 * stribeck / 0.86

    def by(strength: float) -> dict[str, float]:
        excess = min((peak - 1) * strength, steepest)
        return {"kinetic": strength, "static": strength + excess, "stribeck": stribeck}

    return by


def _yielding(rng: Draw) -> ByStrength:
    time_constant = log_uniform(rng, 0.15, 3.0)
    return lambda strength: {"stiffness": 1 / strength, "time_constant": time_constant}


def _layers(rng: Draw) -> ByStrength:
    sign, boundary = rng.choice([-1.0, 1.0]), rng.uniform(0.25, 0.75)
    return lambda strength: {"ratio": float(np.exp(sign * strength)), "boundary": boundary}


def _periodic(name: str, cycles: str, few: int, many: int) -> Callable[[Draw], ByStrength]:
    """Whole cycles per turn, at any phase."""

    def draw(rng: Draw) -> ByStrength:
        drawn = {cycles: float(rng.integers(few, many + 1)), "phase": rng.uniform(-180, 180)}
        return lambda strength: {name: strength, **drawn}

    return draw


FAMILIES: dict[str, Family] = {
    "coulomb_friction": Family(low=5e-5, high=2e-2, draw=_only("level")),
    "stiction": Family(low=5e-5, high=1e-2, draw=_stiction),
    "speed_dependent_friction": Family(low=1e-4, high=6e-2, draw=_only("level")),
    "shear_thinning": Family(
        low=0.01, high=0.7, draw=lambda rng: lambda strength: {"exponent": 1 - strength}
    ),
    "tissue_viscoelasticity": Family(low=2, high=300, draw=_yielding),
    "layered_tissue": Family(low=0.05, high=2.5, draw=_layers),
    "entry_friction": Family(low=5e-3, high=1.5, draw=_only("level")),
    "sheath_friction": Family(low=5e-5, high=1.5e-2, draw=_only("level")),
    "load_dependent_friction": Family(low=0.02, high=1.0, draw=_only("coefficient")),
    "chuck_backlash": Family(low=0.3, high=40, draw=_only("gap")),
    "base_compliance": Family(low=2e-3, high=2, draw=_inverse("stiffness")),
    "tip_drag": Family(low=3e-3, high=2.0, draw=_only("damping")),
    "needle_curvature": Family(low=3e-5, high=2e-2, draw=_with("torque", phase=(-180, 180))),
    "stiffness_error": Family(low=0.01, high=0.6, draw=_factor("scale")),
    "damping_error": Family(low=0.01, high=0.9, draw=_factor("scale")),
    "tip_angle_bias": Family(low=0.05, high=15, draw=_signed("bias")),
    "tip_angle_scale": Family(low=5e-4, high=0.25, draw=_factor("scale")),
    "tip_sensor_delay": Family(low=2e-3, high=0.4, draw=_only("delay")),
    "torque_bias": Family(low=2e-3, high=0.4, draw=_signed("bias")),
}

OUTSIDE_FAMILIES: dict[str, Family] = {
    "hardening_shaft": Family(low=30, high=3e5, draw=_only("coefficient")),
    "lubrication": Family(low=0.05, high=0.85, draw=_with("share", angle=(200, 1500))),
    "one_way_friction": Family(low=1e-4, high=2e-2, draw=_with("level", asymmetry=(0.4, 0.9))),
    "damping_gradient": Family(low=0.1, high=0.95, draw=_signed("gradient")),
    "slipping_chuck": Family(low=0.1, high=20, draw=_inverse("torque")),
    "friction_ageing": Family(
        low=1e-4,
        high=1e-2,
        draw=_with("growth", level=(1e-4, 1e-3), time=(0.2, 1.0), angle=(0.5, 5.0)),
    ),
    "tip_sensor_lag": Family(low=5e-3, high=2.0, draw=_only("time_constant")),
    "torque_drift": Family(low=1e-4, high=0.05, draw=_signed("rate")),
    "torque_ripple": Family(low=5e-3, high=0.5, draw=_periodic("amplitude", "teeth", 3, 12)),
    "tip_sensor_cubic": Family(low=0.01, high=30, draw=_signed("cubic")),
    "tip_sensor_periodic": Family(low=0.1, high=15, draw=_periodic("amplitude", "cycles", 2, 4)),
    "eccentric_encoder": Family(low=0.05, high=30, draw=_with("amplitude", phase=(-180, 180))),
    "axial_crosstalk": Family(low=2e-3, high=0.3, draw=_signed("gain")),
}


def with_effect(rig: Rig, name: str, parameters: dict[str, float]) -> Rig:
    """The rig with one more effect, of the vocabulary or from outside."""
    if name in OUTSIDE_FAMILIES:
        return replace(rig, outside={**rig.outside, name: parameters})
    return replace(rig, effects={**rig.effects, name: parameters})


def without(rig: Rig, name: str) -> Rig:
    """The rig without that effect."""
    return replace(
        rig,
        effects={effect: p for effect, p in rig.effects.items() if effect != name},
        outside={effect: p for effect, p in rig.outside.items() if effect != name},
    )

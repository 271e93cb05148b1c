"""Ranges of the strengths of effects, and how their other parameters are drawn."""

from dataclasses import replace

import numpy as np
from numpy.random import Generator

from validation.logs.profiles import log_uniform
from validation.logs.strengths.family import (
    ByStrength,
    StrengthFamily,
    factor,
    inverse,
    only,
    signed,
    with_others,
)
from validation.logs.strengths.unmodelled import UNMODELLED_FAMILIES
from validation.rig.rig import IndependentRig

TWO_SIDED = {
    "layered_tissue",
    "needle_curvature",
    "stiffness_error",
    "damping_error",
    "tip_angle_bias",
    "tip_angle_scale",
    "torque_bias",
    "torque_scale",
    "base_angle_scale",
    "inserted_offset",
}
"""Strengths below 0 mean the other sign."""


def _free_length(rng: Generator) -> ByStrength:
    """Free length up to 25 mm longer or 15 mm shorter than logged; the shortest free shaft has 20 mm."""
    side = rng.choice([1.0, -0.6])
    return lambda strength: {"offset": side * strength}


def _stiction(rng: Generator) -> ByStrength:
    """Friction peaks that fall hardly faster than the viscous torque rises, so that slip is unique."""
    peak, stribeck = rng.uniform(1.5, 4.0), log_uniform(rng, 0.15, 2.0)
    steepest = 0.015 * stribeck / 0.86

    def by(strength: float) -> dict[str, float]:
        excess = min((peak - 1) * strength, steepest)
        return {"kinetic": strength, "static": strength + excess, "stribeck": stribeck}

    return by


def _yielding(rng: Generator) -> ByStrength:
    time_constant = log_uniform(rng, 0.15, 3.0)
    return lambda strength: {"stiffness": 1 / strength, "time_constant": time_constant}


def _layers(rng: Generator) -> ByStrength:
    sign, boundary = rng.choice([-1.0, 1.0]), rng.uniform(0.25, 0.75)
    return lambda strength: {"ratio": float(np.exp(sign * strength)), "boundary": boundary}


FAMILIES: dict[str, StrengthFamily] = {
    "coulomb_friction": StrengthFamily(low=5e-5, high=2e-2, draw=only("level")),
    "stiction": StrengthFamily(low=5e-5, high=1e-2, draw=_stiction),
    "speed_dependent_friction": StrengthFamily(low=1e-4, high=6e-2, draw=only("level")),
    "shear_thinning": StrengthFamily(
        low=0.01, high=0.7, draw=lambda rng: lambda strength: {"exponent": 1 - strength}
    ),
    "tissue_viscoelasticity": StrengthFamily(low=2, high=300, draw=_yielding),
    "layered_tissue": StrengthFamily(low=0.05, high=2.5, draw=_layers),
    "entry_friction": StrengthFamily(low=5e-3, high=1.5, draw=only("level")),
    "sheath_friction": StrengthFamily(low=5e-5, high=1.5e-2, draw=only("level")),
    "load_dependent_friction": StrengthFamily(low=0.02, high=1.0, draw=only("coefficient")),
    "chuck_backlash": StrengthFamily(low=0.3, high=40, draw=only("gap")),
    "base_compliance": StrengthFamily(low=2e-3, high=2, draw=inverse("stiffness")),
    "tip_drag": StrengthFamily(low=3e-3, high=2.0, draw=only("damping")),
    "needle_curvature": StrengthFamily(
        low=3e-5, high=2e-2, draw=with_others("torque", phase=(-180, 180))
    ),
    "stiffness_error": StrengthFamily(low=0.01, high=0.6, draw=factor("scale")),
    "damping_error": StrengthFamily(low=0.01, high=0.9, draw=factor("scale")),
    "tip_angle_bias": StrengthFamily(low=0.05, high=15, draw=signed("bias")),
    "tip_angle_scale": StrengthFamily(low=5e-4, high=0.25, draw=factor("scale")),
    "tip_sensor_delay": StrengthFamily(low=2e-3, high=0.4, draw=only("delay")),
    "torque_bias": StrengthFamily(low=2e-3, high=0.4, draw=signed("bias")),
}

WRONG_CONSTANT_FAMILIES: dict[str, StrengthFamily] = {
    "torque_scale": StrengthFamily(low=5e-4, high=0.4, draw=factor("scale")),
    "torque_sensor_delay": StrengthFamily(low=1e-3, high=0.4, draw=only("delay")),
    "base_angle_scale": StrengthFamily(low=2e-4, high=0.25, draw=factor("scale")),
    "drive_friction": StrengthFamily(low=2e-3, high=2.0, draw=only("level")),
    "inserted_offset": StrengthFamily(low=0.1, high=20, draw=signed("offset")),
}

UNLISTED_FAMILIES: dict[str, StrengthFamily] = {
    "free_length_error": StrengthFamily(low=1, high=25, draw=_free_length),
    "diameter_error": StrengthFamily(low=0.02, high=0.08, draw=signed("share")),
}

ALL_FAMILIES = FAMILIES | UNMODELLED_FAMILIES | WRONG_CONSTANT_FAMILIES | UNLISTED_FAMILIES


def with_effect(rig: IndependentRig, name: str, parameters: dict[str, float]) -> IndependentRig:
    """The rig with one more effect, modelled or not, or one more wrong constant."""
    if name in UNMODELLED_FAMILIES | UNLISTED_FAMILIES:
        return replace(rig, outside={**rig.outside, name: parameters})
    return replace(rig, effects={**rig.effects, name: parameters})


def without(rig: IndependentRig, name: str) -> IndependentRig:
    """The rig without that effect."""
    return replace(
        rig,
        effects={effect: p for effect, p in rig.effects.items() if effect != name},
        outside={effect: p for effect, p in rig.outside.items() if effect != name},
    )

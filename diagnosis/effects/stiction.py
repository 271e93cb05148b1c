"""Dry friction that falls from static to kinetic with the rate (Stribeck)."""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters

# A fit that has come to static = kinetic has to find back: the corner there is rounded, by
# 3 % of the level in the corner itself and by a thousandth of that at 1.35 times the level.
_ROUND = 0.05


def _apply(rig: RigParameters, kinetic: float, static: float, stribeck: float) -> RigParameters:
    excess = kinetic * _ROUND * float(np.logaddexp(0.0, (static / kinetic - 1.0) / _ROUND))
    return replace(
        rig,
        kinetic_n_mm_per_mm=rig.kinetic_n_mm_per_mm + kinetic,
        static_excess_n_mm_per_mm=excess,
        stribeck_rad_s=stribeck,
    )


def _beyond_dry_friction(level: float) -> tuple[tuple[float, ...], ...]:
    """Typical forms about a constant level: friction falls within the rates at which needles turn."""
    return (
        (0.8 * level, 1.5 * level, 0.8),
        (0.7 * level, 2.5 * level, 0.2),
        (0.8 * level, 2.0 * level, 0.4),
        (0.85 * level, 1.3 * level, 0.1),
        (0.9 * level, 1.4 * level, 0.05),
    )


EFFECT = Effect(
    name="stiction",
    title="stiction (dry friction that falls with the rate, Stribeck)",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="kinetic",
            unit="N mm / mm",
            low=1e-06,
            high=0.05,
            start=(0.0004, 0.001, 0.001, 0.003, 0.0005, 0.001, 0.001),
            logarithmic=True,
        ),
        Parameter(
            name="static",
            unit="N mm / mm",
            low=1e-06,
            high=0.1,
            start=(0.001, 0.002, 0.004, 0.006, 0.002, 0.002, 0.004),
            logarithmic=True,
        ),
        Parameter(
            name="stribeck",
            unit="rad/s",
            low=0.005,
            high=10.0,
            start=(0.07, 0.05, 0.2, 0.1, 0.8, 0.5, 2.5),
            logarithmic=True,
            neutral=None,
        ),
    ),
    apply=_apply,
    contains={"coulomb_friction": _beyond_dry_friction},
    differences=(0.1, 0.03),
    remedy="add to the model dry friction of {kinetic} that rises to {static} at rates below {stribeck}",
    check=(
        "turn at several steady rates, down to the slowest that the drive can hold: the torque "
        "rises as the rate falls"
    ),
)

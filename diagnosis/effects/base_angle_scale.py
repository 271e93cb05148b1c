"""Gain of the base's encoder: its reading / true angle of the drive shaft."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, scale: float) -> RigParameters:
    return replace(rig, base_scale=rig.base_scale * scale)


EFFECT = Effect(
    name="base_angle_scale",
    title="a wrong gain of the base's encoder (gear ratio)",
    place=Place.SENSOR,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.3, high=3.0, start=(0.95, 1.05), logarithmic=True, neutral=1.0
        ),
    ),
    apply=_apply,
    remedy="divide the readings of the base's encoder by {scale}, or correct its gear ratio",
    check=(
        "turn the drive shaft by one full turn, judged by a mark on it, and compare with the encoder"
    ),
)

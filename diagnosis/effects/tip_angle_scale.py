"""Gain of the tip sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, scale: float) -> RigParameters:
    return replace(rig, tip_scale=rig.tip_scale * scale)


EFFECT = Effect(
    name="tip_angle_scale",
    title="a wrong gain of the tip sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.3, high=3.0, start=(0.95, 1.05), logarithmic=True, neutral=1.0
        ),
    ),
    apply=_apply,
    needs="tip_angle_deg",
    remedy="calibrate the tip sensor: divide its readings by {scale}",
    check="turn the needle in air by a known angle and compare it with the tip sensor",
    other_forms=("tip reading over tip_angle, either side of 0",),
)

"""Gain of the tip sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, scale: float) -> RigModel:
    return replace(rig, tip_scale=scale)


EFFECT = Effect(
    name="tip_angle_scale",
    place=Place.SENSOR,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.3, high=3.0, start=(0.95, 1.05), logarithmic=True, nothing=1.0
        ),
    ),
    enter=_enter,
)

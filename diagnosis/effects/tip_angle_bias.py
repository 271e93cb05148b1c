"""Constant offset of the tip sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, bias: float) -> RigModel:
    return replace(rig, tip_bias=rig.tip_bias + bias)


EFFECT = Effect(
    name="tip_angle_bias",
    place=Place.SENSOR,
    parameters=(Parameter(name="bias", unit="deg", low=-60.0, high=60.0, start=(2.0, -2.0)),),
    enter=_enter,
)

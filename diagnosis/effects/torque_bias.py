"""Constant offset of the torque sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, bias: float) -> RigModel:
    return replace(rig, torque_bias=rig.torque_bias + bias)


EFFECT = Effect(
    name="torque_bias",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="bias", unit="N mm", low=-5.0, high=5.0, start=(0.03, -0.03), scale=0.05),
    ),
    enter=_enter,
)

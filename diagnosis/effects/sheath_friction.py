"""Dry torque per mm of free shaft."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, level: float) -> RigModel:
    return replace(rig, sheath=rig.sheath + level)


EFFECT = Effect(
    name="sheath_friction",
    place=Place.DRIVE,
    parameters=(
        Parameter(
            name="level",
            unit="N mm / mm",
            low=1e-06,
            high=0.05,
            start=(0.0002, 0.001, 0.004),
            logarithmic=True,
        ),
    ),
    enter=_enter,
)

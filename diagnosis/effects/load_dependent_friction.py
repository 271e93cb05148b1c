"""Dry torque at the tip in proportion to the torque that the tip carries."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, coefficient: float) -> RigModel:
    return replace(rig, load=rig.load + coefficient)


EFFECT = Effect(
    name="load_dependent_friction",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="coefficient", unit="-", low=0.001, high=3.0, start=(0.05, 0.2, 0.8), logarithmic=True
        ),
    ),
    enter=_enter,
)

"""Dry friction in one place, where the shaft enters."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, level: float) -> RigModel:
    return replace(rig, entry=rig.entry + level)


EFFECT = Effect(
    name="entry_friction",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="level", unit="N mm", low=0.0001, high=3.0, start=(0.02, 0.08, 0.3), logarithmic=True
        ),
    ),
    enter=_enter,
)

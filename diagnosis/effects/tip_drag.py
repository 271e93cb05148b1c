"""Viscous torque in one place, at the tip."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, damping: float) -> RigModel:
    return replace(rig, tip_drag=rig.tip_drag + damping)


EFFECT = Effect(
    name="tip_drag",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="damping",
            unit="N mm s / rad",
            low=0.001,
            high=5.0,
            start=(0.05, 0.2, 0.6),
            logarithmic=True,
        ),
    ),
    enter=_enter,
)

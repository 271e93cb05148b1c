"""Dry friction that shares itself with the axial motion."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, level: float) -> RigModel:
    return replace(rig, shared=rig.shared + level)


EFFECT = Effect(
    name="speed_dependent_friction",
    place=Place.INTERFACE,
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

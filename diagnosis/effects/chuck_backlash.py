"""Play between drive shaft and needle."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, gap: float) -> RigModel:
    return replace(rig, backlash=gap)


EFFECT = Effect(
    name="chuck_backlash",
    place=Place.DRIVE,
    parameters=(
        Parameter(name="gap", unit="deg", low=0.02, high=30.0, start=(0.5, 2.0, 8.0), logarithmic=True),
    ),
    enter=_enter,
)

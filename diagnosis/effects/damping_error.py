"""The true damping over the nominal."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, scale: float) -> RigModel:
    return replace(rig, damping_scale=rig.damping_scale * scale)


EFFECT = Effect(
    name="damping_error",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.2, high=5.0, start=(0.8, 1.25), logarithmic=True, nothing=1.0
        ),
    ),
    enter=_enter,
)

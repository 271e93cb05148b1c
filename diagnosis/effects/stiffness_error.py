"""The true torsional stiffness over the nominal."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, scale: float) -> RigModel:
    return replace(rig, stiffness_scale=rig.stiffness_scale * scale)


EFFECT = Effect(
    name="stiffness_error",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(
            name="scale", unit="-", low=0.3, high=3.0, start=(0.9, 1.15), logarithmic=True, nothing=1.0
        ),
    ),
    enter=_enter,
)

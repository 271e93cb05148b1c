"""A torsion spring between drive shaft and needle."""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, stiffness: float) -> RigModel:
    return replace(rig, base_stiffness=stiffness)


EFFECT = Effect(
    name="base_compliance",
    place=Place.DRIVE,
    parameters=(
        Parameter(
            name="stiffness",
            unit="N mm / rad",
            low=0.3,
            high=500.0,
            start=(50.0, 15.0, 4.0),
            logarithmic=True,
            nothing=math.inf,
        ),
    ),
    enter=_enter,
)

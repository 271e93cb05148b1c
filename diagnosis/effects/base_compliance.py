"""A torsion spring between drive shaft and needle."""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, stiffness: float) -> RigParameters:
    return replace(rig, base_stiffness_n_mm_per_rad=stiffness)


EFFECT = Effect(
    name="base_compliance",
    title="a torsion spring between drive shaft and needle",
    place=Place.DRIVE,
    parameters=(
        Parameter(
            name="stiffness",
            unit="N mm / rad",
            low=0.3,
            high=2000.0,
            start=(50.0, 15.0, 4.0),
            logarithmic=True,
            neutral=math.inf,
        ),
    ),
    apply=_apply,
    remedy=(
        "add to the model a torsion spring of {stiffness} between drive shaft and needle, or "
        "stiffen the coupling"
    ),
    check="hold the needle right behind the chuck, turn the base, and take torque over angle",
)

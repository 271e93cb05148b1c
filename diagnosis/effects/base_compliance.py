"""A torsion spring between drive shaft and needle.

A free shaft that is longer than logged by kappa / stiffness, with the torsional rigidity kappa, is the
same spring: no log tells which of them it is.
"""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters


def _apply(rig: RigParameters, stiffness: float) -> RigParameters:
    return replace(rig, base_stiffness_n_mm_per_rad=stiffness)


def _longer_shaft(rig: NominalRig, stiffness: float) -> str:
    longer_mm = NOMINAL.needle(rig).rigidity_n_mm2 / stiffness
    return f"a free shaft that is {longer_mm:.3g} mm longer than logged"


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
        "measure the free length, since {same} would do the same; if it is right, add to the model a "
        "torsion spring of {stiffness} between drive shaft and needle, or stiffen the coupling"
    ),
    same_as=_longer_shaft,
    check="hold the needle right behind the chuck, turn the base, and take torque over angle",
)

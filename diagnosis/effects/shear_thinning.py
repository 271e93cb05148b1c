"""Viscous torque as a power of the rate, nominal at 1 rad/s."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, exponent: float) -> RigModel:
    return replace(rig, exponent=exponent)


EFFECT = Effect(
    name="shear_thinning",
    place=Place.INTERFACE,
    parameters=(Parameter(name="exponent", unit="-", low=0.2, high=2.0, start=(0.85, 0.6, 1.2)),),
    enter=_enter,
)

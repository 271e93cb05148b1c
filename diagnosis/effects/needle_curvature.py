"""A bent shaft prefers one orientation."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, torque: float, phase: float) -> RigModel:
    return replace(rig, curvature=torque, curvature_phase=phase)


EFFECT = Effect(
    name="needle_curvature",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="torque",
            unit="N mm / mm",
            low=1e-05,
            high=0.05,
            start=(0.001, 0.001, 0.001, 0.001),
            logarithmic=True,
        ),
        Parameter(
            name="phase",
            unit="deg",
            low=-360.0,
            high=360.0,
            start=(0.0, 90.0, 180.0, -90.0),
            scale=10.0,
            period=360.0,
            nothing=None,
        ),
    ),
    enter=_enter,
)

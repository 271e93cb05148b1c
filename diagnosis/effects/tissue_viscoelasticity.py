"""Kelvin-Voigt tissue in series with the interface."""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, stiffness: float, time_constant: float) -> RigModel:
    return replace(rig, tissue_stiffness=stiffness, tissue_time=time_constant)


EFFECT = Effect(
    name="tissue_viscoelasticity",
    place=Place.TISSUE,
    parameters=(
        Parameter(
            name="stiffness",
            unit="N mm / rad / mm",
            low=0.0005,
            high=2.0,
            start=(0.05, 0.02, 0.01, 0.1),
            logarithmic=True,
            nothing=math.inf,
        ),
        Parameter(
            name="time_constant",
            unit="s",
            low=0.01,
            high=20.0,
            start=(0.3, 1.5, 5.0, 0.3),
            logarithmic=True,
            nothing=None,
        ),
    ),
    enter=_enter,
)

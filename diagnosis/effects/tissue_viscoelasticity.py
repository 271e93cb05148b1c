"""Kelvin-Voigt tissue in series with the interface.

The tissue stays where it is while the shaft slides through. What sticks to the shaft is dragged along:
an effect of the same name and parameters, for a log that nothing explains if the tissue stays.
"""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, stiffness: float, time_constant: float) -> RigParameters:
    return replace(
        rig, tissue_stiffness_n_mm_per_rad_per_mm=stiffness, tissue_time_constant_s=time_constant
    )


def _apply_dragged(rig: RigParameters, stiffness: float, time_constant: float) -> RigParameters:
    return replace(_apply(rig, stiffness, time_constant), tissue_dragged_ratio=1.0)


def dragged_along(effect: Effect) -> Effect:
    """The effect of tissue that goes along with a sliding shaft, with the same bounds and starts."""
    return replace(effect, apply=_apply_dragged)


EFFECT = Effect(
    name="tissue_viscoelasticity",
    title="elastic (Kelvin-Voigt) tissue",
    place=Place.TISSUE,
    parameters=(
        Parameter(
            name="stiffness",
            unit="N mm / rad / mm",
            low=5e-05,
            high=2.0,
            start=(0.05, 0.02, 0.01, 0.1),
            logarithmic=True,
            neutral=math.inf,
        ),
        Parameter(
            name="time_constant",
            unit="s",
            low=0.01,
            high=20.0,
            start=(0.3, 1.5, 5.0, 0.3),
            logarithmic=True,
            neutral=None,
        ),
    ),
    apply=_apply,
    remedy=(
        "give the tissue of the model a stiffness of {stiffness} and a time constant of {time_constant}"
    ),
    other_forms=("elastic tissue over position, in layers", "elastic tissue over twist"),
    check="turn by a few degrees, hold, and let go: elastic tissue turns the needle back",
)

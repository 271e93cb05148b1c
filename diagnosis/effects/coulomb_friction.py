"""Dry torque per mm of inserted shaft, the same at any rate."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, level: float) -> RigParameters:
    return replace(rig, kinetic_n_mm_per_mm=rig.kinetic_n_mm_per_mm + level)


EFFECT = Effect(
    name="coulomb_friction",
    title="dry (Coulomb) friction along the shaft",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="level",
            unit="N mm / mm",
            low=1e-06,
            high=0.05,
            start=(0.0002, 0.001, 0.004),
            logarithmic=True,
        ),
    ),
    apply=_apply,
    remedy="add dry friction of {level} along the inserted shaft to the model",
    other_forms=("dry friction over position, in layers", "friction over direction"),
    check="turn slowly at two steady rates: the part of the torque that both share is dry friction",
)

"""Dry torque per mm of free shaft."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, level: float) -> RigParameters:
    return replace(rig, sheath_friction_n_mm_per_mm=rig.sheath_friction_n_mm_per_mm + level)


EFFECT = Effect(
    name="sheath_friction",
    title="dry friction in the sheath of the free shaft",
    place=Place.DRIVE,
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
    remedy="add dry friction of {level} along the free shaft to the model, or lubricate the sheath",
    check=(
        "turn slowly with the needle out of the tissue: what is left of the torque is that of the sheath"
    ),
)

"""Dry torque at the tip in proportion to the torque that the tip carries."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, coefficient: float) -> RigParameters:
    return replace(rig, load_coefficient=rig.load_coefficient + coefficient)


EFFECT = Effect(
    name="load_dependent_friction",
    title="friction that grows with the torque at the tip",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="coefficient", unit="-", low=0.001, high=3.0, start=(0.05, 0.2, 0.8), logarithmic=True
        ),
    ),
    apply=_apply,
    needs="tip_torque_n_mm",
    remedy="add friction at the tip of {coefficient} times the torque that the tip carries to the model",
    check="repeat one slow turn with two known torques at the tip",
)

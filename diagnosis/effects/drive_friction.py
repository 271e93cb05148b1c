"""Dry friction of a bearing between torque sensor and chuck: the needle does not feel it."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, level: float) -> RigParameters:
    return replace(rig, drive_friction_n_mm=level)


EFFECT = Effect(
    name="drive_friction",
    title="dry friction of a bearing behind the torque sensor",
    place=Place.DRIVE,
    parameters=(
        Parameter(
            name="level", unit="N mm", low=0.0001, high=3.0, start=(0.01, 0.05, 0.2), logarithmic=True
        ),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
    remedy=(
        "add dry friction of {level} between torque sensor and chuck to the model, or free the bearing"
    ),
    check="turn the drive without a needle: what the torque sensor reads is the friction of the bearing",
    other_forms=("drive torque over rate",),
)

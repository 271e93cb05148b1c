"""Gain of the torque sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, scale: float) -> RigParameters:
    return replace(rig, torque_scale=rig.torque_scale * scale)


EFFECT = Effect(
    name="torque_scale",
    title="a wrong gain of the torque sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(
            name="scale",
            unit="-",
            low=0.1,
            high=10.0,
            start=(0.9, 1.1),
            logarithmic=True,
            neutral=1.0,
            least_factor=0.003,  # as stiffness and damping, which are off alike
        ),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
    remedy="calibrate the torque sensor: divide its readings by {scale}",
    check="calibrate the torque sensor with a known weight on a lever",
    other_forms=("torque reading over torque",),
)

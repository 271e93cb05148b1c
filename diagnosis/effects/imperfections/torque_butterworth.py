"""Butterworth filter of second order of the torque sensor, with the corner 1 / time_constant."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, time_constant: float) -> RigParameters:
    return replace(rig, torque_butterworth_s=time_constant)


EFFECT = Effect(
    name="torque_butterworth",
    title="a low-pass filter of second order in the torque sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="time_constant", unit="s", low=0.0, high=0.1, start=(0.01, 0.04), scale=0.02),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
)

"""First-order low pass of the torque sensor: time_constant d(shown)/dt = torque - shown."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, time_constant: float) -> RigParameters:
    return replace(rig, torque_low_pass_s=time_constant)


EFFECT = Effect(
    name="torque_low_pass",
    title="a low-pass filter in the torque sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(
            name="time_constant", unit="s", low=0.0, high=0.5, start=(0.01, 0.04, 0.15), scale=0.02
        ),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
)

"""The torque sensor is late by a constant delay."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, delay: float) -> RigParameters:
    return replace(rig, torque_delay_s=delay)


EFFECT = Effect(
    name="torque_sensor_delay",
    title="a delay of the torque sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="delay", unit="s", low=0.0, high=2.0, start=(0.02, 0.1, 0.4), scale=0.1),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
    remedy="move the readings of the torque sensor {delay} earlier",
    check=(
        "strike the drive while it is held: torque and motion begin at once, and what is late is "
        "the sensor"
    ),
)

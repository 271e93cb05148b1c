"""The tip sensor is late by a constant delay."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, delay: float) -> RigParameters:
    return replace(rig, tip_delay_s=delay)


EFFECT = Effect(
    name="tip_sensor_delay",
    title="a delay of the tip sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="delay", unit="s", low=0.0, high=2.0, start=(0.02, 0.1, 0.4), scale=0.1),
    ),
    apply=_apply,
    needs="tip_angle_deg",
    remedy="move the readings of the tip sensor {delay} earlier",
    check="turn the needle in air by a step: the tip follows at once, and what is late is the sensor",
)

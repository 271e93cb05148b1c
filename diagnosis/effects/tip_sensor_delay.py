"""The tip sensor shows what was."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.rig_model import RigModel


def _enter(rig: RigModel, delay: float) -> RigModel:
    return replace(rig, tip_delay=delay)


EFFECT = Effect(
    name="tip_sensor_delay",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="delay", unit="s", low=0.0, high=2.0, start=(0.02, 0.1, 0.4), scale=0.1),
    ),
    enter=_enter,
)

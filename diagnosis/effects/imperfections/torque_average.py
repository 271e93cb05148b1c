"""Moving average of the torque sensor: it shows the mean of the last `window` seconds."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, window: float) -> RigParameters:
    return replace(rig, torque_average_s=window)


EFFECT = Effect(
    name="torque_average",
    title="a torque sensor that shows moving averages",
    place=Place.SENSOR,
    parameters=(Parameter(name="window", unit="s", low=0.0, high=0.3, start=(0.02, 0.08), scale=0.04),),
    apply=_apply,
    needs="base_torque_n_mm",
)

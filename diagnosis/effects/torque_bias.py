"""Constant offset of the torque sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, bias: float) -> RigParameters:
    return replace(rig, torque_bias_n_mm=rig.torque_bias_n_mm + bias)


EFFECT = Effect(
    name="torque_bias",
    title="an offset of the torque sensor",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="bias", unit="N mm", low=-5.0, high=5.0, start=(0.03, -0.03), scale=0.05),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
    remedy="subtract {bias} from the readings of the torque sensor",
    check="read the torque sensor without a needle: it has to show 0",
)

"""Constant offset of the tip sensor."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, bias: float) -> RigParameters:
    return replace(rig, tip_bias_deg=rig.tip_bias_deg + bias)


EFFECT = Effect(
    name="tip_angle_bias",
    title="an offset of the tip sensor",
    place=Place.SENSOR,
    parameters=(Parameter(name="bias", unit="deg", low=-60.0, high=60.0, start=(2.0, -2.0)),),
    apply=_apply,
    needs="tip_angle_deg",
    remedy="subtract {bias} from the readings of the tip sensor",
    check="read the tip sensor on a relaxed needle: it has to show 0",
)

"""Drift of the tip sensor's clock: at time t it shows the value at t (1 + rate)."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, rate: float) -> RigParameters:
    return replace(rig, tip_clock_ratio=1.0 + rate)


EFFECT = Effect(
    name="tip_clock",
    title="a clock of the tip sensor that drifts",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="rate", unit="-", low=-0.02, high=0.02, start=(0.002, -0.002), scale=0.003),
    ),
    apply=_apply,
    needs="tip_angle_deg",
    differs=True,
)

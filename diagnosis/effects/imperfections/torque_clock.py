"""Drift of the torque sensor's clock: at time t it shows the value at t (1 + rate)."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, rate: float) -> RigParameters:
    return replace(rig, torque_clock_ratio=1.0 + rate)


EFFECT = Effect(
    name="torque_clock",
    title="a clock of the torque sensor that drifts",
    place=Place.SENSOR,
    parameters=(
        Parameter(name="rate", unit="-", low=-0.02, high=0.02, start=(0.002, -0.002), scale=0.003),
    ),
    apply=_apply,
    needs="base_torque_n_mm",
    differs=True,
)

"""Viscous torque in one place, at the tip."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, damping: float) -> RigParameters:
    return replace(rig, tip_drag_n_mm_s_per_rad=rig.tip_drag_n_mm_s_per_rad + damping)


EFFECT = Effect(
    name="tip_drag",
    title="viscous drag at the tip",
    place=Place.NEEDLE,
    parameters=(
        Parameter(
            name="damping",
            unit="N mm s / rad",
            low=0.001,
            high=5.0,
            start=(0.05, 0.2, 0.6),
            logarithmic=True,
        ),
    ),
    apply=_apply,
    other_forms=("damping over position, in one section of the shaft",),
    remedy="add viscous drag of {damping} at the tip to the model",
    check="repeat one fast turn at several depths: drag at the tip does not grow with depth",
)

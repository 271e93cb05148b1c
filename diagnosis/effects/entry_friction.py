"""Dry friction in one place, where the shaft enters."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, level: float) -> RigParameters:
    return replace(rig, entry_friction_n_mm=rig.entry_friction_n_mm + level)


EFFECT = Effect(
    name="entry_friction",
    title="dry friction where the shaft enters",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="level", unit="N mm", low=0.0001, high=3.0, start=(0.02, 0.08, 0.3), logarithmic=True
        ),
    ),
    apply=_apply,
    remedy="add dry friction of {level} where the shaft enters to the model",
    check="repeat one slow turn at two depths: friction at the entry does not grow with depth",
)

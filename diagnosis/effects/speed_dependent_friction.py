"""Dry friction that is shared between turning and axial motion."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, level: float) -> RigParameters:
    return replace(rig, shared_n_mm_per_mm=rig.shared_n_mm_per_mm + level)


EFFECT = Effect(
    name="speed_dependent_friction",
    title="dry friction shared with the axial motion",
    place=Place.INTERFACE,
    parameters=(
        Parameter(
            name="level",
            unit="N mm / mm",
            low=1e-06,
            high=0.05,
            start=(0.0002, 0.001, 0.004),
            logarithmic=True,
        ),
    ),
    apply=_apply,
    remedy=(
        "add to the model dry friction of {level} along the inserted shaft that is shared with "
        "the axial motion"
    ),
    check="repeat one slow turn at rest and while the needle slides",
)

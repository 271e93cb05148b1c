"""True inserted length minus the logged one, the same in all trials."""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, offset: float) -> RigParameters:
    return replace(rig, inserted_offset_mm=offset)


EFFECT = Effect(
    name="inserted_offset",
    title="an inserted length that is logged with an offset",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(name="offset", unit="mm", low=-40.0, high=40.0, start=(5.0, -5.0), scale=10.0),
    ),
    apply=_apply,
    remedy="add {offset} to inserted_mm in all trials",
    check="measure the inserted length by itself: with the tip at the surface, inserted_mm has to be 0",
)

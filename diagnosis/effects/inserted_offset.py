"""True inserted length minus the logged one, the same in all trials.

What is inserted more may be free less, as of a surface that is not where it was touched, or not, as of a
needle that is longer than its stage knows: rigs differ, and the share is fitted beside the offset.
"""

from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.replay.rig_parameters import RigParameters


def _apply(rig: RigParameters, offset: float, share: float = 0.0) -> RigParameters:
    return replace(rig, inserted_offset_mm=offset, offset_free_share=share)


EFFECT = Effect(
    name="inserted_offset",
    title="an inserted length that is logged with an offset",
    place=Place.PARAMETERS,
    parameters=(
        Parameter(
            name="offset", unit="mm", low=-40.0, high=40.0, start=(5.0, -5.0, 5.0, -5.0), scale=10.0
        ),
        Parameter(
            name="free_share",
            unit="-",
            low=0.0,
            high=1.0,
            start=(0.0, 0.0, 1.0, 1.0),
            reported=False,
            neutral=None,
            prior_sigma=1.0,
        ),
    ),
    apply=_apply,
    remedy="add {offset} to inserted_mm in all trials",
    check="measure the inserted length by itself: with the tip at the surface, inserted_mm has to be 0",
)

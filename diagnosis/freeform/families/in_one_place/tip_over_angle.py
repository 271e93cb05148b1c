"""Drag, or dry friction, at the tip that depends on its own angle: one side of a bevel cuts fibres.

    strength = level + sum over n of (a_n sin(n angle) + b_n cos(n angle)) + the sizes of these waves

It is never less than the level, so that it only takes energy. The tip lags behind its base: a law of the
base's angle would smear over the turn what happens at one angle of the tip.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.angle import AT_TIP, shown_deg
from diagnosis.freeform.families.in_one_place.tip import dry_at_tip
from diagnosis.freeform.families.shaft.not_round import (
    damping_wave,
    friction_wave,
    level_and_waves,
    size_over_angles,
    sum_of_sizes,
)
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

Laws = Callable[..., tuple[Interface, ...]]
"""Those at the tip, of a level and of sine and cosine of each wave."""

_LEAST = 1e-2  # of the drag that a law starts with: waves may be nearly all of it


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Drag and dry friction over the angle of the tip; none if it hardly turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return (
        _family(ranges, "drag", _drag(ranges), _drag_waves),
        _family(ranges, "dry friction", dry_at_tip(ranges), _dry_waves),
    )


def _family(ranges: LogRanges, what: str, level: Parameter, laws: Laws) -> Family:
    return Family(
        effect=Effect(
            name=f"{what} at the tip over tip_angle",
            title=f"{what} at the tip that depends on its angle",
            place=Place.NEEDLE,
            parameters=level_and_waves(level, len(AT_TIP)),
            apply=partial(_apply, laws),
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="tip_angle",
        title=f"{what} at the tip",
        curve=partial(size_over_angles, shown_deg(ranges), AT_TIP),
        x_unit="deg",
        unit=level.unit,
    )


def _drag(ranges: LogRanges) -> Parameter:
    """Drag at the easiest angle."""
    own = ranges.library["tip_drag"].parameters[0]
    usual = own.start[0]
    return replace(
        own,
        name="level",
        low=_LEAST * usual,
        start=(usual,),
        logarithmic=True,
        neutral=None,
    )


def _drag_waves(level: float, *c: float) -> tuple[Interface, ...]:
    first, *others = (damping_wave(*own) for own in zip(AT_TIP, c[::2], c[1::2], strict=True))
    return first.but(viscous_n_mm_s_per_mm=level + sum_of_sizes(c)), *others


def _dry_waves(level: float, *c: float) -> tuple[Interface, ...]:
    first, *others = (friction_wave(*own) for own in zip(AT_TIP, c[::2], c[1::2], strict=True))
    return first.but(kinetic_n_mm_per_mm=level), *others


def _apply(laws: Laws, rig: RigParameters, *values: float) -> RigParameters:
    return replace(rig, free=FreeLaw(at_tip=laws(*values)))

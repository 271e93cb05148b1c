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

_LEAST = 1e-2  # of the drag that a law starts with: waves may be nearly all of it


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Drag and dry friction over the angle of the tip; none if it hardly turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    return (
        _family(ranges, "drag", _drag(ranges), _apply_drag, "N mm s / rad"),
        _family(ranges, "dry friction", dry_at_tip(ranges), _apply_dry, "N mm"),
    )


def _family(
    ranges: LogRanges,
    what: str,
    level: Parameter,
    apply: Callable[..., RigParameters],
    unit: str,
) -> Family:
    return Family(
        effect=Effect(
            name=f"{what} at the tip over tip_angle",
            title=f"{what} at the tip that depends on its angle",
            place=Place.NEEDLE,
            parameters=level_and_waves(level, len(AT_TIP)),
            apply=apply,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="tip_angle",
        title=f"{what} at the tip",
        curve=partial(size_over_angles, shown_deg(ranges), AT_TIP),
        x_unit="deg",
        unit=unit,
    )


def _drag(ranges: LogRanges) -> Parameter:
    """Drag at the easiest angle."""
    own = ranges.library["tip_drag"].parameters[0]
    usual = own.start[0]
    return Parameter(
        name="level",
        unit=own.unit,
        low=_LEAST * usual,
        high=own.high,
        start=(usual,),
        logarithmic=True,
        neutral=None,
    )


def _apply_drag(rig: RigParameters, level: float, *c: float) -> RigParameters:
    waves = zip(AT_TIP, c[::2], c[1::2], strict=True)
    first, *others = (damping_wave(*own) for own in waves)
    mean = first.but(viscous_n_mm_s_per_mm=level + sum_of_sizes(c))
    return _at_tip(rig, mean, *others)


def _apply_dry(rig: RigParameters, level: float, *c: float) -> RigParameters:
    waves = zip(AT_TIP, c[::2], c[1::2], strict=True)
    first, *others = (friction_wave(*own) for own in waves)
    return _at_tip(rig, first.but(kinetic_n_mm_per_mm=level), *others)


def _at_tip(rig: RigParameters, *laws: Interface) -> RigParameters:
    return replace(rig, free=FreeLaw(at_tip=laws))

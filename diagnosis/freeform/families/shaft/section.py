"""Free laws of a shaft whose surface differs along its length: a coating that is worn, a rough patch.

- dry friction of one section, anywhere
- damping of one section, in addition to the nominal one
- dry friction that changes along the shaft, from its tip on

Only where the inserted length varies: at one length these are laws of the depth below the surface
(in_layers).
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_layers.layers import box, place_of
from diagnosis.freeform.families.interface import PARTS
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates_of, from_neutral
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface, Section

_FROM = (0.02, 0.12, 0.24, 0.36, 0.48, 0.6, 0.75)  # of the greatest depth, where one is looked for
_LONG = 0.2  # of it
_NEAR_TIP_MM, _SHORT = 1.0, 0.1  # where drag at the tip is, and a length of the greatest depth
_ROUGH = (0.01, 100.0, 3.0)  # bounds and start of additional damping, in the nominal one
_PLACES = {Place.INTERFACE: 0.6, Place.NEEDLE: 0.4}


@dataclass(frozen=True, kw_only=True, eq=False)
class _Sections:
    """Equally long sections, from the tip up to the greatest depth of a log, and a curve over them."""

    curve: SmoothCurve
    length_mm: float

    @property
    def from_tip_mm(self) -> tuple[float, ...]:
        return tuple(i * self.length_mm for i in range(self.curve.places.size))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All of them, if the inserted length varies."""
    if Variable.DEPTH not in ranges.ends:
        return ()
    deepest = ranges.deepest_mm
    sections = _Sections(curve=smooth_curve(0.0, 1.0, PARTS), length_mm=deepest / PARTS)
    return (
        _one_section(deepest, ranges),
        _one_rough_section(deepest, ranges),
        _along_the_shaft(sections, ranges),
    )


def _one_section(deepest_mm: float, ranges: LogRanges) -> Family:
    level = ranges.dry_level
    level = replace(level, high=level.high / _LONG, start=(level.start[0] / _LONG,))
    effect = _of_one_section("dry friction", deepest_mm, level, _apply_one)
    return _law(effect, "dry friction along the shaft", "N mm / mm")


def _apply_one(rig: RigParameters, from_tip: float, length: float, level: float) -> RigParameters:
    return replace(rig, free=FreeLaw(sections=(_dry(from_tip, length, level),)))


def _one_rough_section(deepest_mm: float, ranges: LogRanges) -> Family:
    nominal = ranges.damping_n_mm_s_per_mm
    low, high, start = (times * nominal for times in _ROUGH)
    level = Parameter(name="level", unit=VISCOUS, low=low, high=high, start=(start,), logarithmic=True)
    effect = _of_one_section("damping", deepest_mm, level, _apply_one_rough)
    at_the_tip = {"tip_drag": partial(_at_the_tip, _SHORT * deepest_mm)}
    return replace(_law(effect, "additional damping along the shaft", VISCOUS), as_effect=at_the_tip)


def _apply_one_rough(rig: RigParameters, from_tip: float, length: float, level: float) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=level)
    section = Section(interface=law, from_tip_mm=from_tip, length_mm=length)
    return replace(rig, free=FreeLaw(sections=(section,)))


def _at_the_tip(length_mm: float, damping_n_mm_s: float) -> tuple[float, ...]:
    """A short section with the drag of the tip."""
    return _NEAR_TIP_MM, length_mm, damping_n_mm_s / length_mm


def _of_one_section(
    what: str, deepest_mm: float, level: Parameter, apply: Callable[..., RigParameters]
) -> Effect:
    """Place and length of a section, and the level of its law, of which there is one start."""
    from_tip = place_of("from_tip", deepest_mm, _FROM)
    length = replace(from_tip, name="length", start=(_LONG * deepest_mm,) * len(_FROM))
    return Effect(
        name=f"{what} over position, in one section of the shaft",
        title=f"{what} of one section of the shaft",
        place=Place.INTERFACE,
        parameters=(from_tip, length, replace(level, start=level.start * len(_FROM))),
        apply=apply,
        differences=(1e-1, 1e-2),
    )


def _law(effect: Effect, title: str, unit: str) -> Family:
    """The law of one section, told from the tip on."""
    return Family(
        effect=effect,
        places=_PLACES,
        says="position",
        title=title,
        curve=partial(box, 0.0),
        x_unit="mm from the tip",
        unit=unit,
    )


def _along_the_shaft(sections: _Sections, ranges: LogRanges) -> Family:
    level = ranges.dry_level
    return Family(
        effect=Effect(
            name="dry friction over position, from the tip",
            title="dry friction that changes along the shaft",
            place=Place.INTERFACE,
            parameters=(level, *from_neutral(coordinates_of(sections.curve), level)),
            apply=partial(_apply_all, sections),
            differences=(1e-2,),
        ),
        places=_PLACES,
        says="position",
        title="dry friction along the shaft",
        curve=partial(_levels, sections),
        x_unit="mm from the tip",
        unit="N mm / mm",
    )


def _levels(sections: _Sections, level: float, *c: float) -> Points:
    middles = tuple(start + sections.length_mm / 2.0 for start in sections.from_tip_mm)
    return middles, level * np.array(sections.curve.factors(c))


def _apply_all(sections: _Sections, rig: RigParameters, level: float, *c: float) -> RigParameters:
    each = zip(sections.from_tip_mm, sections.curve.factors(c), strict=True)
    own = tuple(_dry(from_tip, sections.length_mm, level * factor) for from_tip, factor in each)
    return replace(rig, free=FreeLaw(sections=own))


def _dry(from_tip_mm: float, length_mm: float, level: float) -> Section:
    law = Interface(kinetic_n_mm_per_mm=level)
    return Section(interface=law, from_tip_mm=from_tip_mm, length_mm=length_mm)

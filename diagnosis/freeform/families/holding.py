"""Free laws of tissue that holds the needle until it slides: along the shaft, or at the tip.

It twists with the needle up to an angle, from where it slips at a level of dry friction, as a spring in
series with friction; and sliding releases the twist. With K the stiffness, level the friction that is
shared with the axial speed v, and q the share of v that counts (models.tissue), a held torque T fades as

    dT/ds = -(K q / (r level)) T    over the travel s,

so that the travel after which it is forgotten, r angle / q, is a number of its own.
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

_TWISTS_DEG = (5.0, 20.0, 60.0)  # to start with
_SHARE = 0.1  # of the axial speed, to start with


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both, if the needle slides."""
    if Variable.AXIAL_SPEED not in ranges.ends:
        return ()
    return _along_the_shaft(ranges), _at_the_tip(ranges)


def _along_the_shaft(ranges: LogRanges) -> Family:
    return Family(
        effect=Effect(
            name="holding friction over turned_by",
            title="tissue that holds the shaft until it slides",
            place=Place.TISSUE,
            parameters=_numbers(ranges, 1.0),
            apply=_apply_along,
            differences=(1e-1, 1e-2),
        ),
        places={Place.TISSUE: 0.5, Place.INTERFACE: 0.5},
        says="history",
        title="friction along the shaft after it has turned back, until it slides",
        curve=_twisted,
        x_unit="deg",
        unit="N mm / mm",
    )


def _at_the_tip(ranges: LogRanges) -> Family:
    """The same in one place."""
    shaft = _along_the_shaft(ranges)
    return replace(
        shaft,
        effect=replace(
            shaft.effect,
            name="holding torque at the tip over turned_by",
            title="tissue that holds the tip until it slides",
            place=Place.NEEDLE,
            parameters=_numbers(ranges, AT_TIP_MM),
            apply=_apply_at_tip,
        ),
        places={Place.NEEDLE: 0.6, Place.TISSUE: 0.4},
        title="friction at the tip after it has turned back, until it slides",
        unit="N mm",
    )


def _numbers(ranges: LogRanges, length_mm: float) -> tuple[Parameter, ...]:
    """Level, twist and share of the axial speed, each with every start."""
    dry = ranges.dry_level
    pairs = [(level * length_mm, twist) for level in dry.start[1:] for twist in _TWISTS_DEG]
    levels, twists = zip(*pairs, strict=True)
    level = replace(dry, low=dry.low * length_mm, high=dry.high * length_mm, start=levels)
    return (
        level,
        _open("twist", "deg", 0.5, 180.0, twists),
        _open("share", "-", 1e-3, 1.0, (_SHARE,) * 6),
    )


def _open(name: str, unit: str, low: float, high: float, start: tuple[float, ...]) -> Parameter:
    return Parameter(
        name=name, unit=unit, low=low, high=high, start=start, logarithmic=True, neutral=None
    )


def _twisted(level: float, twist_deg: float, _: float) -> Points:
    return (0.0, twist_deg, 2.0 * twist_deg), (0.0, level, level)


def _law(level: float, twist_deg: float, share: float) -> Interface:
    return Interface(
        shared_n_mm_per_mm=level,
        shared_axial_ratio=share,
        stiffness_n_mm_per_rad_per_mm=float(level / np.radians(twist_deg)),
    )


def _apply_along(rig: RigParameters, *numbers: float) -> RigParameters:
    return replace(rig, free=FreeLaw(throughout=(_law(*numbers),)))


def _apply_at_tip(rig: RigParameters, *numbers: float) -> RigParameters:
    return replace(rig, free=FreeLaw(at_tip=(_law(*numbers),)))

"""Bonds that twist, and break where they slip: tissue that tears along the shaft, a membrane where it
enters, a barb at the tip that comes loose. Tissue that sticks to the shaft makes them anew at rest.
"""

import math
from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_one_place.rubbing import AT_THE_TIP, ENTRY, Spot
from diagnosis.freeform.family import Family, Points, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.contact import CONTACT_POINTS, ContactCurve, ContactVariable
from models.tissue import Interface

_BROKEN = 6.0  # times the slip of a factor e, after which nothing more breaks
_BONDS = (
    Parameter(
        name="twist",
        unit="deg",
        low=0.5,
        high=180.0,
        start=(5.0, 5.0, 20.0, 20.0, 60.0, 60.0),
        logarithmic=True,
        neutral=None,
    ),
    Parameter(
        name="slip",
        unit="deg",
        low=0.1,
        high=360.0,
        start=(0.5, 8.0) * 3,
        logarithmic=True,
        neutral=None,
    ),
    Parameter(name="left", unit="-", low=0.01, high=1.0, start=(0.05,) * 6, neutral=None),
)


_HEALING = (
    Parameter(
        name="twist", unit="deg", low=0.1, high=45.0, start=(0.3, 3.0), logarithmic=True, neutral=None
    ),
    Parameter(
        name="slip", unit="deg", low=0.5, high=720.0, start=(10.0,) * 2, logarithmic=True, neutral=None
    ),
    Parameter(
        name="time", unit="s", low=0.2, high=100.0, start=(5.0,) * 2, logarithmic=True, neutral=None
    ),
    Parameter(name="left", unit="-", low=0.001, high=1.0, start=(0.05,) * 2, neutral=None),
    Parameter(name="first", unit="-", low=0.0, high=1.0, start=(0.3,) * 2, neutral=None),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Bonds that break, along the shaft and in one place, where the base turns."""
    if Variable.HISTORY not in ranges.ends:
        return ()
    return (
        _along(ranges),
        _healing(ranges),
        *(_in_one_place(spot, ranges) for spot in (ENTRY, AT_THE_TIP)),
    )


def _along(ranges: LogRanges) -> Family:
    """Bristles whose level fades with the slip so far, to a part that stays."""
    level = ranges.dry_level
    starts = len(_BONDS[0].start)
    return Family(
        effect=Effect(
            name="breaking bonds over slip",
            title="bonds between shaft and tissue that twist, and break where they slip",
            place=Place.INTERFACE,
            parameters=(replace(level, start=level.start[-1:] * starts), *_BONDS),
            apply=partial(_apply_bonds, _everywhere),
            differences=(1e-1, 1e-2),
        ),
        places={Place.INTERFACE: 0.5, Place.TISSUE: 0.5},
        says="history",
        title="friction of the bonds along the shaft",
        curve=_broken,
        x_unit="deg of slip",
        unit="N mm / mm",
    )


def _healing(ranges: LogRanges) -> Family:
    """Bonds whose level fades as slip breaks them, and that grow again in time, as stiff as strong."""
    level, along = ranges.dry_level, _along(ranges)
    return replace(
        along,
        effect=replace(
            along.effect,
            name="healing bonds over slip",
            title="bonds between shaft and tissue that break where they slip, and grow again",
            parameters=(replace(level, start=level.start[-1:] * 2), *_HEALING),
            apply=_apply_healing,
        ),
        curve=_broken_share,
        x_unit="of the bonds broken",
    )


def _in_one_place(spot: Spot, ranges: LogRanges) -> Family:
    level, along = spot.dry(ranges), _along(ranges)
    starts = len(_BONDS[0].start)
    return replace(
        along,
        effect=replace(
            along.effect,
            name=f"{spot.name} of breaking bonds over slip",
            title=f"a bond {spot.words} that twists, and breaks where it slips",
            place=most_probable(spot.places),
            parameters=(replace(level, start=level.start[-1:] * starts), *_BONDS),
            apply=partial(_apply_bonds, spot.with_laws),
        ),
        places=spot.places,
        title=f"friction of the bond {spot.words}",
        unit=spot.unit,
    )


def _everywhere(law: Interface) -> FreeLaw:
    return FreeLaw(throughout=(law,))


def _fading(slip_deg: float, left: float) -> ContactCurve:
    """From 1 to what is left, by a factor e within each `slip_deg`."""
    curve = ContactCurve(
        over=ContactVariable.SLIP,
        scale=slip_deg,
        last=_BROKEN * slip_deg,
        factors=(1.0,) * CONTACT_POINTS,
    )
    factors = left + (1.0 - left) * np.exp(-curve.places / slip_deg)
    faded: ContactCurve = curve.but(factors=tuple(factors))
    return faded


def _broken(level: float, _: float, slip_deg: float, left: float) -> Points:
    curve = _fading(slip_deg, left)
    return curve.places, level * np.array(curve.factors)


def _bonds_left(slip_deg: float, time_s: float, left: float, first: float) -> ContactCurve:
    """Straight from 1, where none is broken, to what is left where all are."""
    curve = ContactCurve(
        over=ContactVariable.BROKEN,
        scale=1.0,
        last=1.0,
        factors=(1.0,) * CONTACT_POINTS,
        renewal_deg=slip_deg,
        fading_s=time_s,
        first_broken=first,
    )
    straight: ContactCurve = curve.but(factors=tuple(1.0 - (1.0 - left) * curve.places))
    return straight


def _broken_share(level: float, _: float, *bonds: float) -> Points:
    curve = _bonds_left(*bonds)
    return curve.places, level * np.array(curve.factors)


def _apply_healing(rig: RigParameters, level: float, twist_deg: float, *bonds: float) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, contact=_bonds_left(*bonds))
    return replace(rig, presliding_deg=twist_deg, free=FreeLaw(throughout=(law,)))


def _apply_bonds(
    acting: Callable[[Interface], FreeLaw],
    rig: RigParameters,
    level: float,
    twist_deg: float,
    slip_deg: float,
    left: float,
) -> RigParameters:
    law = Interface(
        kinetic_n_mm_per_mm=level,
        stiffness_n_mm_per_rad_per_mm=level / math.radians(twist_deg),
        contact=_fading(slip_deg, left),
    )
    return replace(rig, free=acting(law))

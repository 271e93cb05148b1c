"""Bonds between shaft and tissue that twist, and break where they slip: tissue that tears."""

import math
from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
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


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law of bonds that break, where the base turns."""
    return (_bonds(ranges),) if Variable.HISTORY in ranges.ends else ()


def _bonds(ranges: LogRanges) -> Family:
    """Bristles whose level fades with the slip so far, to a part that stays."""
    level = ranges.dry_level
    starts = len(_BONDS[0].start)
    return Family(
        effect=Effect(
            name="breaking bonds over slip",
            title="bonds between shaft and tissue that twist, and break where they slip",
            place=Place.INTERFACE,
            parameters=(replace(level, start=level.start[-1:] * starts), *_BONDS),
            apply=_apply_bonds,
            differences=(1e-1, 1e-2),
        ),
        places={Place.INTERFACE: 0.5, Place.TISSUE: 0.5},
        says="history",
        title="friction of the bonds along the shaft",
        curve=_broken,
        x_unit="deg of slip",
        unit="N mm / mm",
    )


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


def _apply_bonds(
    rig: RigParameters, level: float, twist_deg: float, slip_deg: float, left: float
) -> RigParameters:
    law = Interface(
        kinetic_n_mm_per_mm=level,
        stiffness_n_mm_per_rad_per_mm=level / math.radians(twist_deg),
        contact=_fading(slip_deg, left),
    )
    return replace(rig, free=FreeLaw(throughout=(law,)))

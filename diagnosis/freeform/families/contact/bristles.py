"""Dry friction of bristles, which twist before they slip.

LuGre; Canudas de Wit et al., IEEE Trans. Automatic Control 40 (1995).
"""

import math
from dataclasses import replace

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

_BRISTLES = (
    Parameter(
        name="twist", unit="deg", low=0.5, high=90.0, start=(5.0, 15.0), logarithmic=True, neutral=None
    ),
    Parameter(
        name="time", unit="s", low=0.001, high=3.0, start=(0.05, 0.05), logarithmic=True, neutral=None
    ),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law of bristles, where the base turns."""
    return (_bristles(ranges),) if Variable.HISTORY in ranges.ends else ()


def _bristles(ranges: LogRanges) -> Family:
    kinetic, static, stribeck = (
        replace(p, start=p.start[:2]) for p in ranges.library["stiction"].parameters
    )
    return Family(
        effect=Effect(
            name="bristle friction over turned_by",
            title="dry friction of bristles that twist before they slip",
            place=Place.INTERFACE,
            parameters=(kinetic, replace(static, name="excess"), stribeck, *_BRISTLES),
            apply=_apply_bristles,
            differences=(1e-1, 1e-2),
        ),
        places={Place.INTERFACE: 1.0},
        says="history",
        title="dry friction along the shaft after it has turned back",
        curve=_twisted,
        x_unit="deg",
        unit="N mm / mm",
    )


def _twisted(kinetic: float, excess: float, _: float, twist_deg: float, __: float) -> Points:
    """Bristles that are twisted slowly slip at the static level."""
    return (0.0, twist_deg, 2.0 * twist_deg), (0.0, kinetic + excess, kinetic + excess)


def _apply_bristles(
    rig: RigParameters,
    kinetic: float,
    excess: float,
    stribeck_rad_s: float,
    twist_deg: float,
    time_s: float,
) -> RigParameters:
    static = kinetic + excess
    law = Interface(
        kinetic_n_mm_per_mm=kinetic,
        static_n_mm_per_mm=static,
        stribeck_rad_s=stribeck_rad_s,
        stiffness_n_mm_per_rad_per_mm=static / math.radians(twist_deg),
        time_constant_s=time_s,
    )
    return replace(rig, free=FreeLaw(throughout=(law,)))

"""Drag in one place that grows with a power of the rate: at the tip, at the entry, along the free shaft.

At 2 it is that of inertia of what is displaced; below 1, of tissue, grease or gel that thins. A curve of
the rate may be that, too, but starts as drag proportional to the rate, and may come nowhere from there.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter
from diagnosis.freeform.families.in_one_place.rubbing import AT_THE_TIP, SPOTS, Spot
from diagnosis.freeform.family import Family, Points, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

_EXPONENTS = (0.5, 0.5, 2.0, 2.0)  # to start with, each with weak and strong drag
_PLATEAU_RAD_S = 1e-3  # below which drag is proportional to the rate
_SHOWN_RAD_S = np.linspace(-3.0, 3.0, 13)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each place, if the base turns."""
    if Variable.RATE not in ranges.ends:
        return ()
    tip = ranges.library["tip_drag"].parameters[0]
    along = ((spot, spot.drag(ranges)) for spot in SPOTS)
    return (_power(AT_THE_TIP, tip), *(_power(spot, drag) for spot, drag in along))


def _power(spot: Spot, drag: Parameter) -> Family:
    return Family(
        effect=Effect(
            name=f"{spot.name} over rate, a power",
            title=f"drag {spot.words} with a power of the rate",
            place=most_probable(spot.places),
            parameters=(
                replace(drag, start=drag.start[:2] * 2),
                Parameter(name="exponent", unit="-", low=0.2, high=3.0, start=_EXPONENTS, neutral=1.0),
            ),
            apply=partial(_apply, spot),
            differences=(1e-2,),
        ),
        places=spot.places,
        says="rate",
        title=f"torque {spot.words}",
        curve=_at_rates,
        x_unit=UNITS[Variable.RATE],
        unit=spot.unit,
    )


def _at_rates(damping: float, exponent: float) -> Points:
    smooth = _SHOWN_RAD_S**2 + _PLATEAU_RAD_S**2
    return _SHOWN_RAD_S, damping * _SHOWN_RAD_S * smooth ** (0.5 * (exponent - 1.0))


def _apply(spot: Spot, rig: RigParameters, damping: float, exponent: float) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, exponent=exponent, plateau_rad_s=_PLATEAU_RAD_S)
    return replace(rig, free=spot.with_laws(law))

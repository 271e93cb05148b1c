"""A free law of the tip: drag that grows with a power of the rate, as of a bevel that stirs a fluid.

At 2 it is that of inertia of what is displaced; below 1, of tissue that thins. A curve of the rate may
be that, too, but starts as drag proportional to the rate, and may come nowhere from there.
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

_EXPONENTS = (0.5, 0.5, 2.0, 2.0)  # to start with, each with weak and strong drag
_PLATEAU_RAD_S = 1e-3  # below which drag is proportional to the rate
_SHOWN_RAD_S = np.linspace(-3.0, 3.0, 13)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the base turns."""
    return (_at_tip(ranges),) if Variable.RATE in ranges.ends else ()


def _at_tip(ranges: LogRanges) -> Family:
    drag = ranges.library["tip_drag"].parameters[0]
    return Family(
        effect=Effect(
            name="tip torque over rate, a power",
            title="drag in one place, at the tip, with a power of the rate",
            place=Place.NEEDLE,
            parameters=(
                replace(drag, start=drag.start[:2] * 2),
                Parameter(name="exponent", unit="-", low=0.2, high=3.0, start=_EXPONENTS, neutral=1.0),
            ),
            apply=_apply,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="rate",
        title="torque at the tip",
        curve=_at_rates,
        x_unit=UNITS[Variable.RATE],
        unit="N mm",
    )


def _at_rates(damping: float, exponent: float) -> Points:
    smooth = _SHOWN_RAD_S**2 + _PLATEAU_RAD_S**2
    return _SHOWN_RAD_S, damping * _SHOWN_RAD_S * smooth ** (0.5 * (exponent - 1.0))


def _apply(rig: RigParameters, damping: float, exponent: float) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, exponent=exponent, plateau_rad_s=_PLATEAU_RAD_S)
    return replace(rig, free=FreeLaw(at_tip=(law,)))

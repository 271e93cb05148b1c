"""A free law of what turns with the tip: its torque is proportional to the angular acceleration.

A lump of tissue, a sensor, a tool. The shaft itself is light: its inertia hardly ever shows.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models import units

_SHARES = (0.1, 1.0)  # of the largest torque at the largest acceleration of the base, to start with
_MOST = 200.0  # times that: noise of the base is acceleration as well
_SHOWN = 5  # points of the line, either way


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the torque was read and the base is ever accelerated."""
    known = {Variable.TORQUE, Variable.ACCELERATION} <= ranges.ends.keys()
    return (_at_tip(ranges),) if known else ()


def _at_tip(ranges: LogRanges) -> Family:
    fastest, torque = (
        max(abs(end) for end in ranges.ends[v]) for v in (Variable.ACCELERATION, Variable.TORQUE)
    )
    usual = torque / fastest
    inertia = Parameter(
        name="inertia",
        unit="N mm s^2 / rad",
        low=0.0,
        high=_MOST * usual,
        start=tuple(share * usual for share in _SHARES),
        scale=usual,
    )
    return Family(
        effect=Effect(
            name=f"tip torque over {Variable.ACCELERATION}",
            title="inertia of what turns with the tip",
            place=Place.NEEDLE,
            parameters=(inertia,),
            apply=_apply,
        ),
        places={Place.NEEDLE: 1.0},
        says=SAYS[Variable.ACCELERATION],
        title="torque of the inertia at the tip",
        curve=partial(_line, fastest),
        x_unit=UNITS[Variable.ACCELERATION],
        unit="N mm",
    )


def _line(fastest: float, inertia: float) -> Points:
    at = tuple(fastest * i / _SHOWN for i in range(-_SHOWN, _SHOWN + 1))
    return at, tuple(inertia * one for one in at)


def _apply(rig: RigParameters, inertia: float) -> RigParameters:
    return replace(rig, free=FreeLaw(shaft=FreeShaft(tip_inertia_kg_m2=inertia * units.N_MM)))

"""A free law of a shaft that is stiffer one way than the other, as a coil of wire that winds up,

    torque = forwards  GJ twist / length     where it is turned forwards
             backwards GJ twist / length     where it is turned backwards

A smooth curve over the torque has no such corner at rest.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.needle import STIFFNESS_POINTS

_LEAST, _MOST = 0.05, 20.0  # of the nominal stiffness
_STARTS = ((1.0, 0.6), (0.6, 1.0), (1.0, 1.6), (1.6, 1.0))
_ANY_N_MM = 1.0  # the factors are the same at every torque of a sign
_PLACES, _CORNER = 5, 1e-3  # of the step, on either side; the first of them, in the largest torque


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law of a shaft that is stiffer one way."""
    return (
        (_one_way(max(map(abs, ranges.ends[Variable.TORQUE]))),)
        if Variable.TORQUE in ranges.ends
        else ()
    )


def _one_way(most_n_mm: float) -> Family:
    forwards, backwards = zip(*_STARTS, strict=True)
    return Family(
        effect=Effect(
            name="stiffness over torque, each way",
            title="a shaft that is stiffer one way than the other",
            place=Place.NEEDLE,
            parameters=(_factor("forwards", forwards), _factor("backwards", backwards)),
            apply=_apply,
        ),
        places={Place.NEEDLE: 1.0},
        says=Variable.TORQUE,
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, most_n_mm),
        x_unit=UNITS[Variable.TORQUE],
        unit="-",
    )


def _factor(name: str, start: tuple[float, ...]) -> Parameter:
    return Parameter(
        name=name, unit="-", low=_LEAST, high=_MOST, start=start, logarithmic=True, neutral=1.0
    )


def _factors(most_n_mm: float, forwards: float, backwards: float) -> Points:
    up = most_n_mm * np.linspace(_CORNER, 1.0, _PLACES)
    return np.concatenate([-up[::-1], up]), np.repeat([backwards, forwards], _PLACES)


def _apply(rig: RigParameters, forwards: float, backwards: float) -> RigParameters:
    curve = (backwards,) * STIFFNESS_POINTS + (forwards,) * STIFFNESS_POINTS
    shaft = FreeShaft(stiffness_curve=curve, stiffness_torque_n_mm=_ANY_N_MM)
    return replace(rig, free=FreeLaw(shaft=shaft))

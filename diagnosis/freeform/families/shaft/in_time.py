"""Free laws of the material of the shaft in time.

- a shaft that creeps: a torque twists it further in time
- a shaft whose material damps: it resists the rate at which it twists
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LEAST_PAST_S, LONGEST_PAST_S, LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_CREEPS_BY, _CREEPS_S, _CREEP_POINTS = 0.3, (0.3, 2.0, 10.0), 11
_DAMPS_S, _SHOWN_PER_S = (0.02, 0.3), 2.0


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Laws of a material that creeps or damps."""
    return (_creeping(), _damping()) if Variable.TORQUE in ranges.ends else ()


def _creeping() -> Family:
    time = Parameter(
        name="time",
        unit="s",
        low=LEAST_PAST_S,
        high=LONGEST_PAST_S,
        start=_CREEPS_S,
        logarithmic=True,
        neutral=None,
    )
    ratio = Parameter(
        name="ratio",
        unit="-",
        low=1e-3,
        high=10.0,
        start=(_CREEPS_BY,) * len(_CREEPS_S),
        logarithmic=True,
    )
    return Family(
        effect=Effect(
            name="creep of the shaft over past",
            title="a shaft that creeps under a torque",
            place=Place.NEEDLE,
            parameters=(ratio, time),
            apply=_apply_creep,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="history",
        title="twist of the shaft over the elastic one",
        curve=_creep,
        x_unit="s under a torque",
        unit="-",
    )


def _creep(ratio: float, time_s: float) -> Points:
    at_s = time_s * np.linspace(0.0, 5.0, _CREEP_POINTS)
    return at_s, 1.0 - ratio * np.expm1(-at_s / time_s)


def _apply_creep(rig: RigParameters, ratio: float, time_s: float) -> RigParameters:
    return replace(rig, free=FreeLaw(shaft=FreeShaft(creep_ratio=ratio, creep_time_s=time_s)))


def _damping() -> Family:
    time = Parameter(
        name="time",
        unit="s",
        low=1e-3,
        high=10.0,
        start=_DAMPS_S,
        logarithmic=True,
    )
    return Family(
        effect=Effect(
            name="damping of the shaft over rate",
            title="a shaft whose material resists the rate at which it twists",
            place=Place.NEEDLE,
            parameters=(time,),
            apply=_apply_damping,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="rate",
        title="torque of the shaft over the elastic one",
        curve=_damped,
        x_unit="rate over twist, 1/s",
        unit="-",
    )


def _damped(time_s: float) -> Points:
    per_s = np.linspace(0.0, _SHOWN_PER_S, 3)
    return per_s, 1.0 + time_s * per_s


def _apply_damping(rig: RigParameters, time_s: float) -> RigParameters:
    return replace(rig, free=FreeLaw(shaft=FreeShaft(damping_time_s=time_s)))

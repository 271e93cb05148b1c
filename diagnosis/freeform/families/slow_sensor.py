"""Free laws of a tip sensor that follows at a limited rate.

A tracker that smooths what it sees, or a camera that looks for the tip near where it was, is late by a
time constant, and by more where the tip turns fast.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter
from diagnosis.freeform.families.readings import SENSOR, TIP
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_TIMES_S = (0.02, 0.02, 0.02, 0.2, 0.2)
_SHARES = (0.7, 0.4, 0.2, 0.4, 0.2)  # of the fastest turn of the tip, to start with


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The tip sensor, if it was read and turned."""
    if TIP not in ranges.missing or Variable.TIP_RATE not in ranges.ends:
        return ()
    fastest_deg_s = float(np.degrees(max(abs(end) for end in ranges.ends[Variable.TIP_RATE])))
    time = Parameter(
        name="time",
        unit="s",
        low=1e-3,
        high=3.0,
        start=_TIMES_S,
        logarithmic=True,
        neutral=None,
    )
    rate = Parameter(
        name="rate",
        unit="deg/s",
        low=0.01 * fastest_deg_s,
        high=3.0 * fastest_deg_s,
        start=tuple(share * fastest_deg_s for share in _SHARES),
        logarithmic=True,
        neutral=None,
    )
    return (_limited(time, rate),)


def _limited(time: Parameter, rate: Parameter) -> Family:
    return Family(
        effect=Effect(
            name="tip reading over lag",
            title="a tip sensor that follows at a limited rate",
            place=max(SENSOR, key=lambda place: SENSOR[place]),
            parameters=(time, rate),
            apply=_apply,
            differences=(1e-2,),
        ),
        places=SENSOR,
        says="rate",
        title="rate at which the tip sensor follows",
        curve=_follows,
        x_unit="deg of lag",
        unit="deg/s",
    )


def _follows(time_s: float, rate_deg_s: float) -> Points:
    lag_deg = time_s * rate_deg_s
    return (0.0, lag_deg, 2.0 * lag_deg), (0.0, rate_deg_s, rate_deg_s)


def _apply(rig: RigParameters, time_s: float, rate_deg_s: float) -> RigParameters:
    curve = partial(Curve, acts_on=ActsOn.TIP_READING, variable=Variable.LAG)
    own = curve(places=(0.0, time_s * rate_deg_s), values=(0.0, rate_deg_s))
    return replace(rig, free=FreeLaw(curves=(own,)))

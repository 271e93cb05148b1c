"""Free laws of what follows at a limited rate: the tip sensor, or the needle in its chuck.

A tracker that smooths what it sees, or a camera that looks for the tip near where it was, is late by a
time constant, and by more where the tip turns fast. So is a chuck that a clutch or a slow motor turns.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import DRIVE, SENSOR, TIP
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_TIMES_S = (0.02, 0.02, 0.02, 0.2, 0.2)
_SHARES = (0.7, 0.4, 0.2, 0.4, 0.2)  # of the fastest turn, to start with


@dataclass(frozen=True, kw_only=True)
class _Follower:
    """What follows: what its curve acts on, the rate that it is to follow, and words."""

    acts_on: ActsOn
    rate: Variable
    places: Mapping[Place, float]
    words: str


_TIP = _Follower(
    acts_on=ActsOn.TIP_READING, rate=Variable.TIP_RATE, places=SENSOR, words="the tip sensor"
)
_CHUCK = _Follower(
    acts_on=ActsOn.DRIVE_ANGLE, rate=Variable.RATE, places=DRIVE, words="the needle in its chuck"
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both, where they turn; the tip sensor, if it was read."""
    followers = (_TIP, _CHUCK) if TIP in ranges.missing else (_CHUCK,)
    return tuple(_limited(one, ranges) for one in followers if one.rate in ranges.ends)


def _limited(follower: _Follower, ranges: LogRanges) -> Family:
    fastest_deg_s = float(np.degrees(max(abs(end) for end in ranges.ends[follower.rate])))
    time = Parameter(
        name="time", unit="s", low=1e-3, high=3.0, start=_TIMES_S, logarithmic=True, neutral=None
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
    return Family(
        effect=Effect(
            name=f"{follower.acts_on.replace('_', ' ')} over lag",
            title=f"{follower.words} follows at a limited rate",
            place=max(follower.places, key=lambda place: follower.places[place]),
            parameters=(time, rate),
            apply=partial(_apply, follower.acts_on),
            differences=(1e-2,),
        ),
        places=follower.places,
        says="rate",
        title=f"rate at which {follower.words} follows",
        curve=_follows,
        x_unit="deg of lag",
        unit="deg/s",
    )


def _follows(time_s: float, rate_deg_s: float) -> Points:
    lag_deg = time_s * rate_deg_s
    return (0.0, lag_deg, 2.0 * lag_deg), (0.0, rate_deg_s, rate_deg_s)


def _apply(acts_on: ActsOn, rig: RigParameters, time_s: float, rate_deg_s: float) -> RigParameters:
    places, values = (0.0, time_s * rate_deg_s), (0.0, rate_deg_s)
    curve = Curve(acts_on=acts_on, variable=Variable.LAG, places=places, values=values)
    return replace(rig, free=FreeLaw(curves=(curve,)))

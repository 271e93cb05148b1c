"""Free laws of what follows at a limited rate: the tip or torque sensor, or the needle in its chuck.

A tracker that smooths what it sees, or a camera that looks for the tip near where it was, is late by a
time constant, and by more where the tip turns fast. So are an amplifier of limited slew rate, and a
chuck that a clutch or a slow motor turns.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import DRIVE, SENSOR
from diagnosis.freeform.family import Family, Points, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_TIMES_S = (0.02, 0.02, 0.02, 0.2, 0.2)
_SHARES = (0.7, 0.4, 0.2, 0.4, 0.2)  # of the fastest turn, to start with


@dataclass(frozen=True, kw_only=True)
class _Follower:
    """What follows: what its curve acts on, the rate that it is to follow, and words.

    Attributes:
      unit: of what follows: deg, for a rate in rad/s, or that of the rate.
    """

    acts_on: ActsOn
    rate: Variable
    places: Mapping[Place, float]
    words: str
    unit: str = "deg"


_TIP = _Follower(
    acts_on=ActsOn.TIP_READING, rate=Variable.TIP_RATE, places=SENSOR, words="the tip sensor"
)
_TORQUE = _Follower(
    acts_on=ActsOn.TORQUE_READING,
    rate=Variable.TORQUE_RATE,
    places=SENSOR,
    words="the torque sensor",
    unit="N mm",
)
_CHUCK = _Follower(
    acts_on=ActsOn.DRIVE_ANGLE, rate=Variable.RATE, places=DRIVE, words="the needle in its chuck"
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """All that move; the sensors, if they were read."""
    sensors = {TIP: _TIP, TORQUE: _TORQUE}
    read = [own for sensor, own in sensors.items() if sensor in ranges.missing]
    return tuple(_limited(one, ranges) for one in (*read, _CHUCK) if one.rate in ranges.ends)


def _limited(follower: _Follower, ranges: LogRanges) -> Family:
    fastest = max(abs(end) for end in ranges.ends[follower.rate])
    if follower.unit == "deg":
        fastest = float(np.degrees(fastest))
    time = Parameter(
        name="time", unit="s", low=1e-3, high=3.0, start=_TIMES_S, logarithmic=True, neutral=None
    )
    rate = Parameter(
        name="rate",
        unit=f"{follower.unit}/s",
        low=0.01 * fastest,
        high=3.0 * fastest,
        start=tuple(share * fastest for share in _SHARES),
        logarithmic=True,
        neutral=None,
    )
    return Family(
        effect=Effect(
            name=f"{follower.acts_on.replace('_', ' ')} over lag",
            title=f"{follower.words} follows at a limited rate",
            place=most_probable(follower.places),
            parameters=(time, rate),
            apply=partial(_apply, follower.acts_on),
            differences=(1e-2,),
        ),
        places=follower.places,
        says="rate",
        title=f"rate at which {follower.words} follows",
        curve=_follows,
        x_unit=f"{follower.unit} of lag",
        unit=f"{follower.unit}/s",
    )


def _follows(time_s: float, per_s: float) -> Points:
    lag = time_s * per_s
    return (0.0, lag, 2.0 * lag), (0.0, per_s, per_s)


def _apply(acts_on: ActsOn, rig: RigParameters, time_s: float, per_s: float) -> RigParameters:
    places, values = (0.0, time_s * per_s), (0.0, per_s)
    curve = Curve(acts_on=acts_on, variable=Variable.LAG, places=places, values=values)
    return replace(rig, free=FreeLaw(curves=(curve,)))

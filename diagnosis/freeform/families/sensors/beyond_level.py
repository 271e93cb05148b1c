"""A sensor that reads otherwise beyond a level: an amplifier that clips, or switches to another range.

    reading = true value                                            up to the level, to either side of 0
              sign (level + jump + gain (|true value| - level))     beyond it

With a gain of 0 it clips. A smooth curve of the true value has no such corner.
"""

from dataclasses import dataclass, replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import SENSOR, TIP, TORQUE
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

_STARTS = tuple(
    (level, gain, jump * level)
    for level in (0.92, 0.75, 0.55, 0.4, 0.25)
    for gain, jump in ((0.0, 0.0), (1.5, 0.0), (1.3, 0.4))
)  # level and jump in the largest value
_LEAST, _MOST = 0.05, 1.0  # level, of the largest value
_FAR, _CORNER = 3.0, 0.005  # in the largest value


@dataclass(frozen=True, kw_only=True)
class _Reading:
    """What a sensor reads: its column, what its curve acts on and over, and words."""

    sensor: str
    acts_on: ActsOn
    variable: Variable
    words: str
    unit: str


_READINGS = (
    _Reading(
        sensor=TORQUE,
        acts_on=ActsOn.TORQUE_READING,
        variable=Variable.TORQUE,
        words="torque sensor",
        unit="N mm",
    ),
    _Reading(
        sensor=TIP,
        acts_on=ActsOn.TIP_READING,
        variable=Variable.TIP_ANGLE,
        words="tip sensor",
        unit="deg",
    ),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each sensor that was read, and whose true values have ends."""
    return tuple(
        _beyond(own, ranges)
        for own in _READINGS
        if own.sensor in ranges.missing and own.variable in ranges.ends
    )


def _beyond(reading: _Reading, ranges: LogRanges) -> Family:
    largest = max(abs(end) for end in ranges.ends[reading.variable])
    size = ranges.missing[reading.sensor]
    levels, gains, jumps = zip(*_STARTS, strict=True)
    level = Parameter(
        name="level",
        unit=reading.unit,
        low=_LEAST * largest,
        high=_MOST * largest,
        start=tuple(share * largest for share in levels),
        logarithmic=True,
        neutral=None,
    )
    gain = Parameter(name="gain", unit="-", low=-1.0, high=5.0, start=gains, neutral=1.0)
    jump = Parameter(
        name="jump",
        unit=reading.unit,
        low=-_MOST * largest,
        high=_MOST * largest,
        start=tuple(share * largest for share in jumps),
        scale=size,
    )
    name = f"{reading.acts_on.replace('_', ' ')} over {reading.variable}, beyond a level"
    return Family(
        effect=Effect(
            name=name,
            title=f"{reading.words} that reads otherwise beyond a level",
            place=Place.SENSOR,
            parameters=(level, gain, jump),
            apply=partial(_apply, reading, largest),
            differences=(1e-2, 1e-3),
        ),
        places=SENSOR,
        says=SAYS.get(reading.variable, reading.variable),
        title=f"error of the {reading.words} beyond a level",
        curve=partial(_error, largest),
        x_unit=UNITS[reading.variable],
        unit=reading.unit,
    )


def _error(
    largest: float, level: float, gain: float, jump: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The error of the reading, over the true value."""
    corner = _CORNER * largest
    beyond = [level + step * corner for step in (1.0, 2.0)] + [
        level + share * largest for share in (1, 2)
    ]
    errors = [jump + (gain - 1.0) * (value - level) for value in beyond]
    up, added = (level, *beyond, level + _FAR * largest), [0.0, *errors]
    added.append(jump + (gain - 1.0) * _FAR * largest)
    return (
        tuple(-value for value in reversed(up)) + up,
        tuple(-value for value in reversed(added)) + tuple(added),
    )


def _apply(
    reading: _Reading, largest: float, rig: RigParameters, level: float, gain: float, jump: float
) -> RigParameters:
    places, values = _error(largest, level, gain, jump)
    curve = Curve(acts_on=reading.acts_on, variable=reading.variable, places=places, values=values)
    return replace(rig, free=FreeLaw(curves=(curve,)))

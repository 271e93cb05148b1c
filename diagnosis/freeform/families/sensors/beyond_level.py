"""A sensor that reads otherwise beyond a level: an amplifier that clips, or switches to another range.

    reading = true value                                            up to the level, to either side of 0
              sign (level + jump + gain (|true value| - level))     beyond it

With a gain of 0 it clips. A smooth curve of the true value has no such corner. Fits start from the
levels at which jump and gain, by linear least squares, leave least of the nominal residual.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import SENSOR
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.sensor_levels import (
    MOST,
    Reading,
    jump_parameter,
    largest_of,
    level_parameter,
    levels_found,
    read_over_levels,
)
from diagnosis.replay.curve import Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS

Array = NDArray[np.float64]

_GAINS = (-1.0, 5.0)
_CLIPS = (0.92, 0.0, 0.0)  # level, gain and jump of a start where nothing is found
_FAR, _CORNER = 3.0, 0.005  # in the largest value


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each sensor that was read, and whose true values have ends."""
    return tuple(_beyond(own, ranges) for own in read_over_levels(ranges))


def _beyond(reading: Reading, ranges: LogRanges) -> Family:
    largest = largest_of(reading, ranges)
    levels, gains, jumps = zip(*_starts(reading, ranges, largest), strict=True)
    gain = Parameter(name="gain", unit="-", low=_GAINS[0], high=_GAINS[1], start=gains, neutral=1.0)
    parameters = (
        level_parameter(reading, largest, levels),
        gain,
        jump_parameter(reading, ranges, largest, jumps),
    )
    name = f"{reading.acts_on.replace('_', ' ')} over {reading.variable}, beyond a level"
    return Family(
        effect=Effect(
            name=name,
            title=f"{reading.words} that reads otherwise beyond a level",
            place=Place.SENSOR,
            parameters=parameters,
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


def _starts(
    reading: Reading, ranges: LogRanges, largest: float
) -> tuple[tuple[float, float, float], ...]:
    """Level, gain and jump."""
    most = MOST * largest
    starts = tuple(
        (level, float(np.clip(1.0 + slope, *_GAINS)), float(np.clip(jump, -most, most)))
        for level, jump, slope in levels_found(reading, ranges, _beyond_a_level)
    )
    return starts or ((_CLIPS[0] * largest, *_CLIPS[1:]),)


def _beyond_a_level(size: Array, level: float) -> Array:
    beyond = size > level
    return np.stack([beyond, np.where(beyond, size - level, 0.0)], axis=1)


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
    reading: Reading, largest: float, rig: RigParameters, level: float, gain: float, jump: float
) -> RigParameters:
    places, values = _error(largest, level, gain, jump)
    curve = Curve(acts_on=reading.acts_on, variable=reading.variable, places=places, values=values)
    return replace(rig, free=FreeLaw(curves=(curve,)))

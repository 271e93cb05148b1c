"""A sensor that reads otherwise beyond a level: an amplifier that clips, or switches to another range.

    reading = true value                                            up to the level, to either side of 0
              sign (level + jump + gain (|true value| - level))     beyond it

With a gain of 0 it clips. A smooth curve of the true value has no such corner. Fits start from the
levels at which jump and gain, by linear least squares, leave least of the nominal residual.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import SENSOR
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

_LEAST, _MOST = 0.05, 1.0  # level, of the largest value
_TRIED, _STARTS = 40, 4  # levels
_GAINS = (-1.0, 5.0)
_CLIPS = (0.92, 0.0, 0.0)  # level, gain and jump of a start where nothing is found
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
    levels, gains, jumps = zip(*_found(reading, ranges, largest), strict=True)
    level = Parameter(
        name="level",
        unit=reading.unit,
        low=_LEAST * largest,
        high=_MOST * largest,
        start=levels,
        logarithmic=True,
        neutral=None,
    )
    gain = Parameter(name="gain", unit="-", low=_GAINS[0], high=_GAINS[1], start=gains, neutral=1.0)
    jump = Parameter(
        name="jump",
        unit=reading.unit,
        low=-_MOST * largest,
        high=_MOST * largest,
        start=jumps,
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


def _found(
    reading: _Reading, ranges: LogRanges, largest: float
) -> tuple[tuple[float, float, float], ...]:
    """Level, gain and jump that leave least of the nominal residual, best first."""
    read = [
        own[reading.sensor]
        for trial, own in zip(ranges.problem.log.trials, ranges.nominal, strict=True)
        if trial.has(reading.sensor)
    ]
    true, left = np.concatenate(read), np.concatenate(ranges.left[reading.sensor])
    true, left = true[np.isfinite(left)], left[np.isfinite(left)]
    size, error = np.abs(true), left * np.sign(true)
    tried = []
    for level in np.geomspace(_LEAST, _MOST, _TRIED)[:-1] * largest:
        beyond = size > level
        if beyond.any():
            columns = np.stack([np.ones(beyond.sum()), size[beyond] - level], axis=1)
            (jump, slope), *_ = np.linalg.lstsq(columns, error[beyond])
            taken_off = float(error[beyond] @ columns @ (jump, slope))
            tried.append((taken_off, float(level), float(np.clip(1.0 + slope, *_GAINS)), float(jump)))
    best = sorted(tried, reverse=True)[:_STARTS]
    most = _MOST * largest
    starts = tuple((level, gain, float(np.clip(jump, -most, most))) for _, level, gain, jump in best)
    return starts or ((_CLIPS[0] * largest, *_CLIPS[1:]),)


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

"""Laws of a sensor that reads otherwise on one side of a level, of either sign of the true value.

Each has a level, a gain on its side of it, and a jump. Fits start from the levels at which jump and
gain, by linear least squares, leave least of the nominal residual.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable

Array = NDArray[np.float64]
Start = tuple[float, float, float]
"""Level, gain and jump."""

CORNER, FAR = 0.005, 3.0
"""Width of what stands for a jump, and the end of a curve, in the largest value."""
_LEAST, _MOST = 0.05, 1.0  # level, of the largest value
_TRIED, _STARTS = 40, 4  # levels


@dataclass(frozen=True, kw_only=True)
class LevelLaw:
    """A law of a sensor on one side of a level.

    Attributes:
      where: its side, in words.
      columns: what jump and slope of the error are multiplied by, over the size of true values and a
        level, (N, 2).
      error: places and values of the error over the true value, of the largest value, level, gain and
        jump.
      gains: the least and the largest gain.
      start: of a fit where nothing is found, in the largest value.
    """

    where: str
    columns: Callable[[Array, float], Array]
    error: Callable[[float, float, float, float], tuple[tuple[float, ...], tuple[float, ...]]]
    gains: tuple[float, float]
    start: Start

    def families(self, ranges: LogRanges) -> tuple[Family, ...]:
        """That of each sensor that was read, and whose true values have ends."""
        read = (r for r in _READINGS if r.sensor in ranges.missing and r.variable in ranges.ends)
        return tuple(_family(self, reading, ranges) for reading in read)


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


def odd(up: tuple[float, ...]) -> tuple[float, ...]:
    """Values of an odd curve on both sides of 0, from those on one side, without 0."""
    return (*(-value for value in reversed(up)), *up)


def _family(law: LevelLaw, reading: _Reading, ranges: LogRanges) -> Family:
    largest = max(abs(end) for end in ranges.ends[reading.variable])
    name = f"{reading.acts_on.replace('_', ' ')} over {reading.variable}, {law.where}"
    return Family(
        effect=Effect(
            name=name,
            title=f"{reading.words} that reads otherwise {law.where}",
            place=Place.SENSOR,
            parameters=_parameters(law, reading, ranges, largest),
            apply=partial(_apply, law, reading, largest),
            differences=(1e-2, 1e-3),
        ),
        places={Place.SENSOR: 1.0},
        says=SAYS.get(reading.variable, reading.variable),
        title=f"error of the {reading.words} {law.where}",
        curve=partial(law.error, largest),
        x_unit=UNITS[reading.variable],
        unit=reading.unit,
    )


def _parameters(
    law: LevelLaw, reading: _Reading, ranges: LogRanges, largest: float
) -> tuple[Parameter, Parameter, Parameter]:
    """Level, gain and jump."""
    most = _MOST * largest
    levels, gains, jumps = zip(*_starts(law, reading, ranges, largest), strict=True)
    level = Parameter(
        name="level",
        unit=reading.unit,
        low=_LEAST * largest,
        high=most,
        start=levels,
        logarithmic=True,
        neutral=None,
    )
    gain = Parameter(
        name="gain", unit="-", low=law.gains[0], high=law.gains[1], start=gains, neutral=1.0
    )
    jump = Parameter(
        name="jump",
        unit=reading.unit,
        low=-most,
        high=most,
        start=jumps,
        scale=ranges.missing[reading.sensor],
    )
    return level, gain, jump


def _starts(law: LevelLaw, reading: _Reading, ranges: LogRanges, largest: float) -> tuple[Start, ...]:
    """Those that leave least of the nominal residual, best first."""
    size, error = _size_and_error(reading, ranges)
    most, tried = _MOST * largest, list[tuple[float, Start]]()
    for level in map(float, np.geomspace(_LEAST, _MOST, _TRIED)[:-1] * largest):
        columns = law.columns(size, level)
        if columns.any():
            jump, slope = np.linalg.lstsq(columns, error)[0]
            gain = float(np.clip(1.0 + slope, *law.gains))
            taken_off = float(error @ columns @ (jump, slope))
            tried.append((taken_off, (level, gain, float(np.clip(jump, -most, most)))))
    best = tuple(start for _, start in sorted(tried, reverse=True)[:_STARTS])
    level, gain, jump = law.start
    return best or ((level * largest, gain, jump * largest),)


def _size_and_error(reading: _Reading, ranges: LogRanges) -> tuple[Array, Array]:
    """Size of the nominal readings, and the residual in their direction, (N,) each."""
    read = [
        own[reading.sensor]
        for trial, own in zip(ranges.problem.log.trials, ranges.nominal, strict=True)
        if trial.has(reading.sensor)
    ]
    true, left = np.concatenate(read), np.concatenate(ranges.left[reading.sensor])
    seen = np.isfinite(left)
    return np.abs(true[seen]), left[seen] * np.sign(true[seen])


def _apply(
    law: LevelLaw,
    reading: _Reading,
    largest: float,
    rig: RigParameters,
    level: float,
    gain: float,
    jump: float,
) -> RigParameters:
    places, values = law.error(largest, level, gain, jump)
    curve = Curve(acts_on=reading.acts_on, variable=reading.variable, places=places, values=values)
    return replace(rig, free=FreeLaw(curves=(curve,)))

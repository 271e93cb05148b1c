"""What a sensor reads of small and of large true values, told apart at a level: starts of such laws."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Parameter
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.variables import Variable

Array = NDArray[np.float64]

_LEAST, MOST = 0.05, 1.0  # level, of the largest value
_TRIED, _STARTS = 40, 4  # levels


@dataclass(frozen=True, kw_only=True)
class Reading:
    """What a sensor reads: its column, what its curve acts on and over, and words."""

    sensor: str
    acts_on: ActsOn
    variable: Variable
    words: str
    unit: str


READINGS = (
    Reading(
        sensor=TORQUE,
        acts_on=ActsOn.TORQUE_READING,
        variable=Variable.TORQUE,
        words="torque sensor",
        unit="N mm",
    ),
    Reading(
        sensor=TIP,
        acts_on=ActsOn.TIP_READING,
        variable=Variable.TIP_ANGLE,
        words="tip sensor",
        unit="deg",
    ),
)


def read_over_levels(ranges: LogRanges) -> tuple[Reading, ...]:
    """Sensors that were read, and whose true values have ends."""
    return tuple(own for own in READINGS if own.sensor in ranges.missing and own.variable in ranges.ends)


def largest_of(reading: Reading, ranges: LogRanges) -> float:
    """The largest true value of a sensor, of either sign."""
    return max(abs(end) for end in ranges.ends[reading.variable])


def level_parameter(reading: Reading, largest: float, levels: tuple[float, ...]) -> Parameter:
    """The level, which starts at each of some."""
    return Parameter(
        name="level",
        unit=reading.unit,
        low=_LEAST * largest,
        high=MOST * largest,
        start=levels,
        logarithmic=True,
        neutral=None,
    )


def jump_parameter(
    reading: Reading, ranges: LogRanges, largest: float, jumps: tuple[float, ...]
) -> Parameter:
    """A jump of the reading at the level, which starts with each of some."""
    return Parameter(
        name="jump",
        unit=reading.unit,
        low=-MOST * largest,
        high=MOST * largest,
        start=jumps,
        scale=ranges.missing[reading.sensor],
    )


def levels_found(
    reading: Reading, ranges: LogRanges, columns_of: Callable[[Array, float], Array]
) -> list[tuple[float, float, float]]:
    """Levels that leave least of the nominal residual, best first, each with the two coefficients of
    its columns by linear least squares.

    Args:
      columns_of: columns of the error over the size of true values and a level, (N, 2).
    """
    read = [
        own[reading.sensor]
        for trial, own in zip(ranges.problem.log.trials, ranges.nominal, strict=True)
        if trial.has(reading.sensor)
    ]
    true, left = np.concatenate(read), np.concatenate(ranges.left[reading.sensor])
    true, left = true[np.isfinite(left)], left[np.isfinite(left)]
    error, tried = left * np.sign(true), []
    for level in np.geomspace(_LEAST, MOST, _TRIED)[:-1] * largest_of(reading, ranges):
        columns = columns_of(np.abs(true), float(level))
        if columns.any():
            one, other = np.linalg.lstsq(columns, error)[0]
            tried.append(
                (float(error @ columns @ (one, other)), (float(level), float(one), float(other)))
            )
    return [found for _, found in sorted(tried, reverse=True)[:_STARTS]]

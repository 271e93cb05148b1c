"""A sensor that reads otherwise beyond a level: an amplifier that clips, or switches to another range.

    reading = true value                                            up to the level, to either side of 0
              sign (level + jump + gain (|true value| - level))     beyond it

With a gain of 0 it clips. A smooth curve of the true value has no such corner.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.templates.sensor_levels import CORNER, FAR, LevelLaw, odd

Array = NDArray[np.float64]


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each sensor that was read, and whose true values have ends."""
    return _BEYOND.families(ranges)


def _columns(size: Array, level: float) -> Array:
    beyond = size > level
    return np.stack([beyond, np.where(beyond, size - level, 0.0)], axis=1)


def _error(
    largest: float, level: float, gain: float, jump: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The error of the reading, over the true value."""
    corner, slope = CORNER * largest, gain - 1.0
    beyond = (level + corner, level + 2.0 * corner, level + largest, level + 2.0 * largest)
    far = level + FAR * largest
    added = (*(jump + slope * (value - level) for value in beyond), jump + slope * FAR * largest)
    return odd((level, *beyond, far)), odd((0.0, *added))


_BEYOND = LevelLaw(
    where="beyond a level",
    columns=_columns,
    error=_error,
    gains=(-1.0, 5.0),
    start=(0.92, 0.0, 0.0),  # it clips
)

"""A sensor that reads otherwise below a level: a load cell that does not give way to a small torque.

    reading = gain true value                            up to the level, to either side of 0
              sign (|true value| + jump)                 beyond it

With a gain of 0 it is dead below the level; with a jump of -level as well, it reads what is beyond. A
smooth curve of the true value has no such corners.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.templates.sensor_levels import CORNER, FAR, LevelLaw, odd

Array = NDArray[np.float64]


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each sensor that was read, and whose true values have ends."""
    return _BELOW.families(ranges)


def _columns(size: Array, level: float) -> Array:
    below = size <= level
    return np.stack([~below, np.where(below, size, 0.0)], axis=1)


def _error(
    largest: float, level: float, gain: float, jump: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """The error of the reading, over the true value."""
    corner, slope = CORNER * largest, gain - 1.0
    inside = (1.0 - CORNER) * level
    up = (inside, level, level + corner, level + 2.0 * corner, FAR * largest)
    added = (slope * inside, slope * level, jump, jump, jump)
    return odd(up), odd(added)


_BELOW = LevelLaw(
    where="below a level",
    columns=_columns,
    error=_error,
    gains=(-1.0, 3.0),
    start=(0.1, 0.0, 0.0),  # it is dead
)

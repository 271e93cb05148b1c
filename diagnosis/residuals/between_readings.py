"""Readings at all rows of a log, for pictures: a line from one to the next, none where many are missing.

A sensor that is slower than the log, or whose readings were smoothed, counts in some rows alone. A line
through NaN would not be seen.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_MISSING = 3.0  # usual times between readings: longer, something is missing


def between_readings(time_s: Array, values: Array) -> Array:
    """Values with those between readings filled in, (N,); NaN before, after and in gaps."""
    read = np.flatnonzero(np.isfinite(values))
    if read.size < 2:
        return values
    filled = np.interp(time_s, time_s[read], values[read], left=np.nan, right=np.nan)
    apart = np.diff(time_s[read])
    follows = np.clip(np.searchsorted(read, np.arange(values.size), side="right"), 1, apart.size)
    missing = apart[follows - 1] > _MISSING * np.median(apart)
    return np.where(missing, values, filled)

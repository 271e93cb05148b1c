"""Filters of a signal: a first-order low pass, and a coupling with play."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def low_passed(values: Array, dt_s: float, time_constant_s: float) -> Array:
    """First-order low pass, settled at the first value; exact if values are linear within steps."""
    decay = np.exp(-dt_s / time_constant_s)
    shown = values.copy()
    ramp = time_constant_s / dt_s * (1 - decay)
    for i in range(1, shown.size):
        before, after = values[i - 1], values[i]
        shown[i] = decay * shown[i - 1] + (ramp - decay) * before + (1 - ramp) * after
    return shown


def followed_with_play(values: Array, half_width: float) -> Array:
    """Values that follow with play, starting in the middle of it, (N,)."""
    followed = values.copy()
    for i in range(1, values.size):
        low, high = values[i] - half_width, values[i] + half_width
        followed[i] = min(max(followed[i - 1], low), high)
    return followed

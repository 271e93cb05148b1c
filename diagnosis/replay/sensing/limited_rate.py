"""A sensor whose reading follows at a limited rate.

    d(shown)/dt = clamp((value - shown) / tau, -most, most)

by backward Euler, solved exactly at each sample: a filter of first order that no step can hurry.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]


@njit(cache=True)
def lag_at_limited_rate(
    time_s: Array, values: Array, time_constant_s: float, most_per_s: float
) -> Array:
    """Value less what is shown, (N,); 0 at the start.

    Args:
      time_s: of the samples, (N,).
      most_per_s: highest rate of what is shown, in the unit of the values per s.
    """
    lag = np.zeros(values.size)
    for i in range(1, values.size):
        step_s = time_s[i] - time_s[i - 1]
        ahead = lag[i - 1] + values[i] - values[i - 1]
        follows = ahead * step_s / (time_constant_s + step_s)
        most = most_per_s * step_s
        lag[i] = ahead - min(max(follows, -most), most)
    return lag

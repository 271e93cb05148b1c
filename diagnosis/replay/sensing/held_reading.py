"""A sensor that shows a new value only once that is far enough from what it shows.

    shown before           while |value - shown before| < most
    value                  once it is not

as a filter against jitter does, or an instrument that reports by exception. It sees the value all the
time, so between two samples it moves by whole steps: by most trunc((value - shown before) / most).
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

Array = NDArray[np.float64]


@njit(cache=True)
def held_back(values: Array, most: float) -> Array:
    """What is shown less the value, (N,); 0 at the start.

    Args:
      values: of the samples, (N,).
      most: above 0, by which a value may differ from what is shown, in the unit of the values.
    """
    back = np.zeros(values.size)
    shown = values[0] if values.size else 0.0
    for i in range(values.size):
        shown += most * np.trunc((values[i] - shown) / most)
        back[i] = shown - values[i]
    return back

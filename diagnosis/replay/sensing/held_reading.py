"""A sensor that shows a new value only once that is far enough from what it shows.

    shown(t) = shown before           while |value(t) - shown before| <= most
               value(t)               beyond it

as a filter against jitter does, or an instrument that reports by exception.
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
      most: by which a value may differ from what is shown, in the unit of the values.
    """
    back = np.zeros(values.size)
    shown = values[0] if values.size else 0.0
    for i in range(values.size):
        if abs(values[i] - shown) > most:
            shown = values[i]
        back[i] = shown - values[i]
    return back

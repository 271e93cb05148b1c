"""White noise of a signal, from its own differences: the one owner of this estimate.

Differences of order k leave of a slow signal almost nothing, and of white noise of one standard
deviation sqrt(binom(2k, k)). Where fast motion has a part in the largest of them, only the smaller
share is used, whose root mean square is known for a normal distribution:

    order 1  of a residual that is white already: best use of the data
    order 2  of a reading, whose motion is left in a tenth of them
    order 4  of measured minus nominal, whatever the nominal model lacks
"""

from collections.abc import Sequence
from math import comb, sqrt

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import LEAST_DIFFERENCES

Array = NDArray[np.float64]

# Root mean square of a standard normal distribution within its central share, by order.
_CENTRAL_SHARE = {1: 1.0, 2: 0.9, 4: 0.75}
_CENTRAL_RMS = {1: 1.0, 2: 1 / 1.267, 4: 0.60706}


def white_noise(parts: Sequence[Array], *, order: int) -> float:
    """Standard deviation of the white part of signals, in their unit.

    Args:
      parts: signals, (N,) each; what is not finite is left out.
      order: of the differences: 1, 2 or 4.

    Returns:
      NaN from fewer than 20 differences.
    """
    each = [np.diff(values[np.isfinite(values)], n=order) for values in parts]
    sizes = np.sort(np.abs(np.concatenate(each))) if each else np.zeros(0)
    if sizes.size < LEAST_DIFFERENCES:
        return float("nan")
    kept = sizes[: max(1, round(_CENTRAL_SHARE[order] * sizes.size))]
    rms = float(np.sqrt(np.mean(kept**2)))
    return rms / _CENTRAL_RMS[order] / sqrt(comb(2 * order, order))

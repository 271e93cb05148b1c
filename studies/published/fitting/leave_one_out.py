"""The fit without one figure: one linear step from the fit to all of them."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

from studies.published.criteria import LONGEST_STEP

Array = NDArray[np.float64]

_OPEN = 1e-12  # lsq_linear wants its bounds apart


def vector_without(
    i: int, x: Array, residual: Array, jacobian: Array, bounds: tuple[Array, Array]
) -> Array:
    """The vector after one Gauss-Newton step on all figures but figure i, within bounds, (k,).

    Args:
      x: the fit to all figures, (k,).
      residual, jacobian: at `x`, (n,) and (n, k).
      bounds: lowest and highest vector, (k,) each.
    """
    low, high = bounds
    others = np.arange(residual.size) != i
    box = (
        np.minimum(np.maximum(low - x, -LONGEST_STEP), -_OPEN),
        np.maximum(np.minimum(high - x, LONGEST_STEP), _OPEN),
    )
    step = lsq_linear(jacobian[others], -residual[others], bounds=box).x
    return np.asarray(np.clip(x + step, low, high), np.float64)

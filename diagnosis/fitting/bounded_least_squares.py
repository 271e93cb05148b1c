"""Linear least squares within bounds, and what they promise of a fit."""

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import lsq_linear

Array = NDArray[np.float64]

_ROOM = 1e-7  # that the solver asks for between bounds, in the units of a fit


def bounded_least_squares(matrix: Array, wanted: Array, low: Array, high: Array) -> Array:
    """The x between `low` and `high`, which may be equal, that minimises |matrix x - wanted|.

    Clipping the free solution would not do: if one entry is at its bound, others move less.
    """
    if not matrix.shape[1]:
        return np.zeros(0)
    solved = lsq_linear(matrix, wanted, bounds=(low - _ROOM, high + _ROOM), method="bvls")
    return np.asarray(np.clip(solved.x, low, high))


def predicted_reduction(slopes: Array, residual: Array, low: Array, high: Array) -> float:
    """What a step between `low` and `high` takes off the sum of squares, by the linear model."""
    size = slopes.shape[1]
    whole = np.asarray(np.linalg.qr(np.column_stack([slopes, residual]), mode="r"))
    root, seen = whole[:size, :size], whole[:size, size]  # of the residual, what lies along the slopes
    step = bounded_least_squares(root, -seen, low, high)
    return float(seen @ seen - np.sum((seen + root @ step) ** 2))

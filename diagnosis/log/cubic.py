"""What four neighbours say of a sample: the cubic through two on each side, over uneven times."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def interpolated(time_s: Array, values: Array, near: int, far: int) -> tuple[Array, Array]:
    """Values of the cubics (Lagrange), and by how much sample less value amplifies white noise.

    Args:
      near, far: neighbours that the cubic goes through, samples away on each side.

    Returns:
      (N,) each; NaN where a trial has no such neighbours.
    """
    n = values.size
    said, gain = np.full(n, np.nan), np.full(n, np.nan)
    middle = np.arange(far, n - far)
    at = [middle - far, middle - near, middle + near, middle + far]
    weights = []
    for i, own in enumerate(at):
        others = [other for j, other in enumerate(at) if j != i]
        top = np.prod([time_s[middle] - time_s[other] for other in others], axis=0)
        weights.append(top / np.prod([time_s[own] - time_s[other] for other in others], axis=0))
    said[middle] = sum(w * values[a] for w, a in zip(weights, at, strict=True))
    gain[middle] = np.sqrt(1 + sum(w**2 for w in weights))
    return said, gain

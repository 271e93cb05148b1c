"""What the pictures of a report have in common: colours, lines and hatches, names of the sensors.

What is nominal and what is explained differ in line, hatch and lightness as well as in colour, so that a
page printed in grey, or seen by an eye that tells no red from blue, says the same.
"""

from collections.abc import Iterable

import numpy as np
from matplotlib.patheffects import withStroke
from numpy.typing import NDArray

MEASURED = "0.6"
PREDICTIONS = {"nominal": "#3c8dd5", "explained": "#940f1c"}
LINES = {"nominal": "--", "explained": "-"}
HATCHES = {"nominal": "////", "explained": ""}
LABELS = {"tip_angle_deg": "tip, deg", "base_torque_n_mm": "base torque, N mm"}
WHITE_BEHIND = (withStroke(linewidth=3.0, foreground="white"),)
"""A rim for lines that cross others."""
WIDE = 11.0
"""Width of a picture, inches; on a phone it scrolls."""


def block_means(values: NDArray[np.float64], most: int) -> NDArray[np.float64]:
    """Means over equal blocks, at most so many."""
    block = -(-values.size // most) or 1
    starts = np.arange(0, values.size, block)
    counts = np.diff(np.append(starts, values.size))
    return np.add.reduceat(values, starts) / counts if values.size else values


def rms(parts: Iterable[NDArray[np.float64]]) -> float:
    """Root mean square of what was read of several arrays; 0 of nothing."""
    every = np.concatenate([*(part[np.isfinite(part)] for part in parts), np.zeros(0)])
    return float(np.sqrt(np.mean(every**2))) if every.size else 0.0

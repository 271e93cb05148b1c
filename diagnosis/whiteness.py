"""Whether a residual is at the noise floor: as small as noise, and as white.

The gap is the root mean square of the residual over its noise. What is left of an
effect is slow beside the samples: the means of blocks of 25 samples, scaled by 5,
have the same root mean square as the samples if these are white, and a larger one
if something slow is left.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLOCK = 25
# The noise is estimated from the same data, to about 1 % from thousands of samples; the
# simulation's own error is below a tenth of the noise, which adds half a per cent.
GAP_LIMIT = 1.03
# White blocks have 1 +- 1 / sqrt(2 blocks), 0.025 for 20 000 samples; noise of the base
# angle, which comes back as torque, is not quite white.
SLOW_LIMIT = 1.25


@dataclass(frozen=True, kw_only=True)
class Floor:
    """How far a residual is above the noise floor: 1 is at it."""

    gap: float
    slow: float

    @property
    def reached(self) -> bool:
        """Whether nothing beyond noise is left."""
        return self.gap <= GAP_LIMIT and self.slow <= SLOW_LIMIT


def floor_of(by_trial: Sequence[Array]) -> Floor:
    """Gap and slow part of residuals over noise, one array a trial and sensor."""
    values = np.concatenate([r for r in by_trial if r.size]) if by_trial else np.zeros(0)
    blocks = [r[: r.size // BLOCK * BLOCK].reshape(-1, BLOCK).mean(axis=1) for r in by_trial]
    means = np.concatenate(blocks) if blocks else np.zeros(0)
    gap = float(np.sqrt(np.mean(values**2))) if values.size else float("nan")
    slow = float(np.sqrt(BLOCK * np.mean(means**2))) if means.size else 1.0
    return Floor(gap=gap, slow=slow)

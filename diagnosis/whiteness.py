"""Whether a residual is at the noise floor: as small as noise, and as white.

The gap is the root mean square of the residual over its noise. What is left of an
effect is slow beside the samples: the means of blocks of 25 samples, scaled by 5,
have the same root mean square as the samples if these are white, and a larger one
if something slow is left.

Chance moves both. Of n white samples, the root mean square over the noise that their
own first differences tell scatters by 1 / (2 sqrt(n)) (von Neumann's ratio), that of
m means by 1 / sqrt(2 m). Limits are wide enough for 3.5 of these.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

BLOCK = 25
_CHANCE = 3.5  # standard deviations: one white residual in 4000 is above
# From thousands of samples: the simulation's own error is below a tenth of the noise, which
# adds half a per cent; noise of the base angle, which comes back as torque, is not quite white.
_GAP_LIMIT = 1.03
_SLOW_LIMIT = 1.25


@dataclass(frozen=True, kw_only=True)
class Floor:
    """How far a residual is above the noise floor: 1 is at it.

    Attributes:
      gap: root mean square over the noise.
      slow: that of means, scaled.
      gap_limit: largest gap that is at the floor.
      slow_limit: largest slow part that is.
    """

    gap: float
    slow: float
    gap_limit: float = _GAP_LIMIT
    slow_limit: float = _SLOW_LIMIT

    @property
    def small(self) -> bool:
        """Whether the residual is no larger than noise."""
        return self.gap <= self.gap_limit

    @property
    def reached(self) -> bool:
        """Whether nothing beyond noise is left."""
        return self.small and self.slow <= self.slow_limit


def floor_of(by_trial: Sequence[Array]) -> Floor:
    """Gap and slow part of residuals over noise, one array a trial and sensor."""
    values = np.concatenate([r for r in by_trial if r.size]) if by_trial else np.zeros(0)
    blocks = [r[: r.size // BLOCK * BLOCK].reshape(-1, BLOCK).mean(axis=1) for r in by_trial]
    means = np.concatenate(blocks) if blocks else np.zeros(0)
    return Floor(
        gap=float(np.sqrt(np.mean(values**2))) if values.size else float("nan"),
        slow=float(np.sqrt(BLOCK * np.mean(means**2))) if means.size else 1.0,
        gap_limit=float(max(_GAP_LIMIT, 1 + 0.5 * _CHANCE / np.sqrt(max(values.size, 1)))),
        slow_limit=float(max(_SLOW_LIMIT, 1 + _CHANCE / np.sqrt(2 * max(means.size, 1)))),
    )

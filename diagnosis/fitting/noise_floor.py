"""Whether a residual is at the noise floor: as small as noise, and as white.

The gap is the root mean square of residual / sigma. The remainder of an
effect is slow compared with the samples: the means of blocks of 25 samples, times 5,
have the same root mean square as the samples if these are white, and a larger one
if something slow is left.

Both scatter by chance. For n white samples whose sigma is from their own first differences, the
root mean square / sigma scatters by 1 / (2 sqrt(n)) (von Neumann's ratio), that of
m means by 1 / sqrt(2 m). The limits allow 3.5 of these (FLOOR_SIGMA).
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import FLOOR_SIGMA, GAP_LIMIT, SLOW_BLOCK, SLOW_LIMIT

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class NoiseFloor:
    """How far a residual is above the noise floor: 1 is at it.

    Attributes:
      gap: root mean square of residual / sigma.
      slow: root mean square of block means, scaled.
      gap_limit: largest gap at the floor.
      slow_limit: largest slow part at the floor.
    """

    gap: float
    slow: float
    gap_limit: float = GAP_LIMIT
    slow_limit: float = SLOW_LIMIT

    def allowing(self, change: "NoiseFloor") -> "NoiseFloor":
        """The floor if another error, independent of the noise, changes residuals by this."""
        return replace(
            self,
            gap_limit=float(np.hypot(self.gap_limit, change.gap)),
            slow_limit=float(np.hypot(self.slow_limit, change.slow)),
        )

    def times(self, factor: float) -> "NoiseFloor":
        """The floor of residuals so many times as large."""
        return replace(self, gap=factor * self.gap, slow=factor * self.slow)

    def within(self, factor: float) -> bool:
        """Whether it is at the floor, or above it by no more than that factor."""
        return self.gap <= factor * self.gap_limit and self.slow <= factor * self.slow_limit

    @property
    def small(self) -> bool:
        """Whether the residual is no larger than noise."""
        return self.gap <= self.gap_limit

    @property
    def reached(self) -> bool:
        """Whether nothing beyond noise is left."""
        return self.small and self.slow <= self.slow_limit


def floor_of(by_trial: Sequence[Array], block: int = SLOW_BLOCK) -> NoiseFloor:
    """Gap and slow part of residuals / sigma, one array per trial.

    Args:
      block: number of samples per block.
    """
    values = np.concatenate([r for r in by_trial if r.size]) if by_trial else np.zeros(0)
    blocks = [r[: r.size // block * block].reshape(-1, block).mean(axis=1) for r in by_trial]
    means = np.concatenate(blocks) if blocks else np.zeros(0)
    return NoiseFloor(
        gap=float(np.sqrt(np.mean(values**2))) if values.size else float("nan"),
        slow=float(np.sqrt(block * np.mean(means**2))) if means.size else 1.0,
        gap_limit=float(max(GAP_LIMIT, 1 + 0.5 * FLOOR_SIGMA / np.sqrt(max(values.size, 1)))),
        slow_limit=float(max(SLOW_LIMIT, 1 + FLOOR_SIGMA / np.sqrt(2 * max(means.size, 1)))),
    )

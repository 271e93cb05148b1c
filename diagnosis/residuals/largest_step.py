"""The step in a residual that takes most off the cost of a fit, whose parameters answer to it.

A step s, 0 up to a sample and 1 from there to the end of a block, takes off

    (s' r)^2 / (s' s),    both orthogonal to the slopes of the fit,

and its size is s' r / s' s. Sums over the rest of a block give this of every sample at once.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class ResidualStep:
    """A step.

    Attributes:
      block: its number.
      sample: first sample of the block after the step.
      gain: that it takes off the cost.
    """

    block: int
    sample: int
    gain: float


def largest_step(
    left: Array, slopes: Array, blocks: Sequence[slice], beside: int
) -> ResidualStep | None:
    """The step that takes most off; None: no block is long enough.

    Args:
      left: residual in sigma, (N,).
      slopes: of what else is fitted, (N, n).
      blocks: rows of one sensor in one trial each, in the order of time.
      beside: samples of a block on either side of a step at least.
    """
    basis, _ = np.linalg.qr(slopes)
    beyond = left - basis @ (basis.T @ left)
    found = []
    for number, block in enumerate(blocks):
        taken = _reductions(beyond[block], basis[block])
        middle = taken[beside : taken.size - beside]
        if middle.size:
            at = int(np.argmax(middle))
            found.append(ResidualStep(block=number, sample=at + beside, gain=float(middle[at])))
    return max(found, key=lambda step: step.gain, default=None)


def _reductions(left: Array, basis: Array) -> Array:
    """Reduction of the cost by a step at every sample of a block, (M,)."""
    along = np.cumsum(left[::-1])[::-1]
    within = np.cumsum(basis[::-1], axis=0)[::-1]
    size = np.arange(left.size, 0, -1) - np.sum(within**2, axis=1)
    return np.asarray(along**2 / np.maximum(size, 1e-9 * left.size))

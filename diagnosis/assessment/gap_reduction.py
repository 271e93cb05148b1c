"""How much of the gap is explained, on trials that the fit has not seen."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_BOOTSTRAPS = 400
_BLOCK = 100  # samples that are resampled together: residuals of a gap are not independent


@dataclass(frozen=True, kw_only=True)
class GapReduction:
    """Root mean square of residual / sigma before and after, on held-out trials; 1 is the noise floor.

    Attributes:
      shrink: 1 - after / before, with a 95 % interval from resampled blocks.
    """

    before: float
    after: float
    shrink: float
    shrink_low: float
    shrink_high: float


def gap_reduction(before: tuple[Array, ...], after: tuple[Array, ...]) -> GapReduction:
    """Gap before and after on held-out trials, and its reduction with an interval by resampling."""
    squares = [
        np.stack([_blocks(b**2), _blocks(a**2)])
        for b, a in zip(before, after, strict=True)
        if b.size >= _BLOCK
    ]
    pooled = np.concatenate(squares, axis=1) if squares else np.ones((2, 1))
    ratio = _shrink(pooled)
    rng = np.random.default_rng(0)
    picks = rng.integers(0, pooled.shape[1], size=(_BOOTSTRAPS, pooled.shape[1]))
    low, high = np.quantile([_shrink(pooled[:, pick]) for pick in picks], [0.025, 0.975])
    return GapReduction(
        before=_rms(before),
        after=_rms(after),
        shrink=ratio,
        shrink_low=float(low),
        shrink_high=float(high),
    )


def _blocks(values: Array) -> Array:
    return np.asarray(values[: values.size // _BLOCK * _BLOCK].reshape(-1, _BLOCK).mean(axis=1))


def _shrink(squares: Array) -> float:
    before, after = squares.mean(axis=1)
    return float(1 - np.sqrt(after / before)) if before > 0 else 0.0


def _rms(by_trial: tuple[Array, ...]) -> float:
    values = np.concatenate(by_trial)
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")

"""How much of the gap is explained, on trials that the fit has not seen."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.fitting.held_out.words import UNSEEN

Array = NDArray[np.float64]

_BOOTSTRAPS = 400
_BLOCK, _LEAST_BLOCKS = 100, 20  # samples resampled together, as residuals of a gap are not independent


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

    @property
    def refutes(self) -> str:
        """Why what was fitted explains nothing, as the end of a sentence; empty: it may.

        Trials that its fit has not seen are predicted worse than by the nominal rig, far beyond chance,
        and not at the noise: parameters that hold in all trials took up what differs among them.
        """
        if self.shrink_high >= 0.0 or self.after <= GAP_LIMIT:
            return ""
        instead = f"{self.after:.3g} instead of {self.before:.3g} σ"
        return f"{UNSEEN} it leaves more than the nominal model: {instead}"


def gap_reduction(before: tuple[Array, ...], after: tuple[Array, ...]) -> GapReduction:
    """Gap before and after on held-out trials, and its reduction with an interval by resampling."""
    length = max(1, min(_BLOCK, sum(trial.size for trial in before) // _LEAST_BLOCKS))
    squares = np.stack([_sums_of_squares(before, length), _sums_of_squares(after, length)])
    picks = np.random.default_rng(0).integers(0, squares.shape[1], size=(_BOOTSTRAPS, squares.shape[1]))
    low, high = np.quantile([_shrink(squares[:, pick]) for pick in picks], [0.025, 0.975])
    return GapReduction(
        before=_rms(before),
        after=_rms(after),
        shrink=_shrink(squares),
        shrink_low=float(low),
        shrink_high=float(high),
    )


def _sums_of_squares(by_trial: tuple[Array, ...], length: int) -> Array:
    """Of blocks of about so many samples, none of which reaches into another trial."""
    blocks = (np.array_split(trial, max(1, trial.size // length)) for trial in by_trial)
    return np.array([block @ block for of_trial in blocks for block in of_trial])


def _shrink(squares: Array) -> float:
    before, after = squares.sum(axis=1)
    return float(1 - np.sqrt(after / before)) if before > 0 else 0.0


def _rms(by_trial: tuple[Array, ...]) -> float:
    values = np.concatenate(by_trial)
    return float(np.sqrt(np.mean(values**2))) if values.size else float("nan")

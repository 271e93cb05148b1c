"""When a residual steps: the sample from which it moves to another level.

The step is the one that takes most off beside a mean (`largest_step`). A needle takes its time to
follow, so the residual began to move before: after the last sample, smoothed, that had gone less than a
tenth of the way, or less than its noise.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import uniform_filter1d

from diagnosis.residuals.largest_step import ResidualStep, largest_step

Array = NDArray[np.float64]

LEAST_S = 0.5  # from either end
_BESIDE_S = 2.0  # before and after a step, that tell its size
_BEGUN, _SMOOTH, _CLEAR = 0.1, 5, 3.0  # part of the way; samples in a mean; standard deviations of it


def step_of(time_s: Array, left: Array) -> ResidualStep | None:
    """The step of a trial, from the sample where it begins; None: the trial is too short.

    Args:
      time_s: s after the start, (N,).
      left: residual that was read then, (N,).
    """
    beside = int(np.searchsorted(time_s, LEAST_S, side="right"))
    step = largest_step(left, np.ones((left.size, 1)), [slice(None)], beside)
    if step is None or step.gain <= 0:
        return None
    begins = _beginning(time_s, left, step.sample)
    return ResidualStep(block=step.block, sample=begins, gain=step.gain)


def _beginning(time_s: Array, left: Array, sample: int) -> int:
    """The sample from which it moved; that of the step itself if nothing was read shortly before."""
    beside_s = time_s - time_s[sample]
    shortly = left[(beside_s < 0) & (beside_s > -_BESIDE_S)]
    if shortly.size == 0:
        return sample
    before = float(np.median(shortly))
    change = float(np.median(left[(beside_s >= 0) & (beside_s < _BESIDE_S)])) - before
    noise = float(np.std(np.diff(left))) / math.sqrt(2.0 * _SMOOTH)
    smooth = uniform_filter1d(left, _SMOOTH, mode="nearest")
    gone = (smooth[:sample] - before) * np.sign(change)
    still = np.flatnonzero(gone < max(_BEGUN * abs(change), _CLEAR * noise))
    return int(still[-1]) + 1 if still.size else sample

"""The time of a log at which its residual is largest."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from diagnosis.residuals.trial_residual import TrialResidual

Array = NDArray[np.float64]

_WINDOW_S = 0.25


def largest_moment(residuals: Sequence[TrialResidual]) -> tuple[str, float]:
    """Trial and time, s, at which means of both sensors over a quarter of a second are largest.

    Noise averages out within the window, and a single outlier does not count.
    """
    found = [(*_largest(residual), residual.trial.name) for residual in residuals]
    _, at_s, name = max(found, key=lambda one: one[0])
    return name, at_s


def _largest(residual: TrialResidual) -> tuple[float, float]:
    """The largest sum of squared means / sigma, and the time in the middle of it."""
    time = residual.trial["time_s"]
    width = min(max(1, round(_WINDOW_S / float(np.median(np.diff(time))))), time.size)
    means = [_running_mean(left, width) ** 2 for left in residual.left.values()]
    total = np.sum(means, axis=0) if means else np.zeros(time.size)
    place = int(np.argmax(total))
    return float(total[place]), float(time[place])


def _running_mean(values: Array, width: int) -> Array:
    """Mean of the readings in a window around each sample, (N,); 0 where there are none."""
    read, window = np.isfinite(values), np.ones(width)
    count = np.convolve(read, window, mode="same")
    return np.asarray(
        np.convolve(np.where(read, values, 0.0), window, mode="same") / np.maximum(count, 1)
    )

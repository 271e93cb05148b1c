"""What a fit gains if what may differ between trials does: a clock that runs off by another rate.

With J the slopes of the fit, r its residual, and D the columns of J of such parameters, each split into
its trials, the linear model promises

    gain = min over x of |r + J x|^2 - min over x, y of |r + J x + D y|^2 - (size of y) log(1 + samples)

where the trials beyond the first have a y each. What a second effect takes off of that is no sign of it.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from diagnosis.effects import FITTED
from diagnosis.fitting.bounded_least_squares import predicted_reduction
from diagnosis.fitting.fit import Fit

Array = NDArray[np.float64]


def gain_of_own_values(fit: Fit) -> float:
    """Cost that values of their own in each trial take off, less what these cost; at least 0."""
    split = _split_by_trial(fit)
    if not split.shape[1]:
        return 0.0
    more = np.hstack([fit.slopes, split])
    saved = _promised(more, fit.residual) - _promised(fit.slopes, fit.residual)
    cost = int(split.shape[1]) * math.log(1.0 + fit.samples)
    return max(saved - cost, 0.0)


def _split_by_trial(fit: Fit) -> Array:
    """Columns of parameters that may differ, of each trial but the first, (N, k)."""
    owners = fit.parameterization.owners
    entries = [i for i, owner in enumerate(owners) if owner in FITTED and FITTED[owner].differs]
    rows = fit.residual.size
    if not entries or len(fit.jacobian) < 2:
        return np.zeros((rows, 0))
    by_trial = block_diag(*(own[:, entries] for own in fit.jacobian))[:, len(entries) :]
    return np.vstack([by_trial, np.zeros((rows - by_trial.shape[0], by_trial.shape[1]))])


def _promised(slopes: Array, residual: Array) -> float:
    """What a step without bounds takes off."""
    free = np.full(slopes.shape[1], np.inf)
    return predicted_reduction(slopes, residual, -free, free)

"""What a fit predicts on trials that it has not seen.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial's residual moves with its Jacobian.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.fit import Fit

Array = NDArray[np.float64]


def information(fit: Fit, *, without: int | None = None) -> tuple[Array, Array]:
    """J'J and J'r with the prior, over all trials but one."""
    n = fit.x.size
    matrix, gradient = 1e-9 * np.eye(n), np.zeros(n)
    for i, (residual, jacobian) in enumerate(zip(fit.by_trial, fit.jacobian, strict=True)):
        if i != without:
            matrix += jacobian.T @ jacobian
            gradient += jacobian.T @ residual
    weights = fit.coordinates.weights**2
    matrix += np.diag(weights)
    gradient += weights * fit.x
    return matrix, gradient


def held_out(fit: Fit) -> tuple[Array, ...]:
    """Residuals over noise of each trial, predicted without it."""
    if fit.x.size == 0 or len(fit.by_trial) < 2:
        return fit.by_trial
    low, high = fit.coordinates.bounds()
    found = []
    for i, (residual, jacobian) in enumerate(zip(fit.by_trial, fit.jacobian, strict=True)):
        matrix, gradient = information(fit, without=i)
        step = -np.linalg.lstsq(matrix, gradient, rcond=None)[0]
        # What the other trials do not show at all stays within its bounds.
        found.append(residual + jacobian @ (np.clip(fit.x + step, low, high) - fit.x))
    return tuple(found)

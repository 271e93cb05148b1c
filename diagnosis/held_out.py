"""What a fit predicts on trials that it has not seen, and how sure its parameters are.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial's residual moves with its Jacobian. Parameters
have the covariance of the whole fit, prior included.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.fit import NUISANCE_SPREAD, Fit

Array = NDArray[np.float64]

_Z95 = 1.959964


def information(fit: Fit, *, without: int | None = None) -> tuple[Array, Array]:
    """J'J and J'r with the prior, over all trials but one."""
    n = fit.x.size
    matrix, gradient = 1e-9 * np.eye(n), np.zeros(n)
    for i, (residual, jacobian) in enumerate(zip(fit.by_trial, fit.jacobian, strict=True)):
        if i != without:
            matrix += jacobian.T @ jacobian
            gradient += jacobian.T @ residual
    count = len(fit.coordinates.nuisance)
    if count:
        inside = np.arange(n - count, n)
        matrix[inside, inside] += 1 / NUISANCE_SPREAD**2
        gradient[inside] += fit.x[inside] / NUISANCE_SPREAD**2
    return matrix, gradient


def held_out(fit: Fit) -> tuple[Array, ...]:
    """Residuals over noise of each trial, predicted without it."""
    if fit.x.size == 0 or len(fit.by_trial) < 2:
        return fit.by_trial
    found = []
    for i, (residual, jacobian) in enumerate(zip(fit.by_trial, fit.jacobian, strict=True)):
        matrix, gradient = information(fit, without=i)
        step = -np.linalg.lstsq(matrix, gradient, rcond=None)[0]
        found.append(residual + jacobian @ step)
    return tuple(found)


def intervals(fit: Fit) -> list[tuple[float, float, float]]:
    """Value, low and high of a 95 % interval of every parameter, in order."""
    matrix, _ = information(fit)
    spread = np.sqrt(np.diag(np.linalg.pinv(matrix))) if fit.x.size else np.zeros(0)
    low, high = fit.coordinates.bounds()
    ends = [np.clip(fit.x + s * _Z95 * spread, low, high) for s in (-1, 1)]
    values = [fit.coordinates.values(x) for x in (fit.x, *ends)]
    return [(v, min(a, b), max(a, b)) for v, a, b in zip(*values, strict=True)]

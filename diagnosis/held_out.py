"""What a fit predicts on trials that it has not seen.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial is simulated with them. Whose rate the tissue
resists is a convention of the rig, not a finding: it stays as fitted.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.nuisance import CONVENTIONS
from diagnosis.predict import predict, residuals

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


def held_out(evidence: Evidence, fit: Fit) -> tuple[Array, ...]:
    """Residuals over noise of each trial, simulated with what the others say.

    Raises:
      SimulationFailed: the others lead to where the needle cannot be simulated.
    """
    found = []
    for trial, step in zip(evidence.log.trials, _steps(fit), strict=True):
        rig = fit.coordinates.rig(fit.x + step)
        prediction = predict(evidence.log.rig, trial, [rig], evidence.resolution)[0]
        found.append(residuals(trial, prediction, evidence.noise))
    return tuple(found)


def surprise(fit: Fit) -> float:
    """How far predictions of unseen trials move, over what noise in the parameters explains.

    About 1 or less where all trials tell the same: sum of |J step|^2 over that of the
    trace of J C J', with C the covariance of the parameters without the trial.
    """
    moved, explained = 0.0, 0.0
    for i, (jacobian, step) in enumerate(zip(fit.jacobian, _steps(fit), strict=True)):
        known = _open(fit)
        spread = np.linalg.pinv(information(fit, without=i)[0][np.ix_(known, known)])
        moved += float(np.sum((jacobian @ step) ** 2))
        explained += float(np.sum((jacobian[:, known] @ spread) * jacobian[:, known]))
    return moved / explained if explained > 0 else 0.0


def _open(fit: Fit) -> NDArray[np.int_]:
    """Entries that are found again without a trial."""
    return np.array([i for i, o in enumerate(fit.coordinates.owners) if o not in CONVENTIONS], int)


def _steps(fit: Fit) -> list[Array]:
    """How the parameters move without each trial, within their bounds."""
    known = _open(fit)
    low, high = fit.coordinates.bounds()
    found = []
    for i in range(len(fit.by_trial)):
        step = np.zeros(fit.x.size)
        if known.size and len(fit.by_trial) > 1:
            matrix, gradient = information(fit, without=i)
            inner = matrix[np.ix_(known, known)]
            step[known] = -np.linalg.lstsq(inner, gradient[known], rcond=None)[0]
        found.append(np.clip(fit.x + step, low, high) - fit.x if step.any() else step)
    return found

"""What a fit predicts on trials that it has not seen.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial is simulated with them. Whose rate the tissue
resists is a convention of the rig, not a finding: it stays as fitted.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.bounded import least_squares
from diagnosis.evidence import Evidence
from diagnosis.fit import Fit
from diagnosis.nuisance import CONVENTIONS
from diagnosis.predict import predict, residuals

Array = NDArray[np.float64]

_AT_BOUND = 1e-6  # from a bound, in the units of the fit
_FAINT = 3e-5  # pull of what nothing else tells


def information(fit: Fit, *, without: int | None = None) -> Array:
    """J'J with the prior, over all trials but one: the inverse covariance of the parameters."""
    slopes = _slopes(fit, without=without)
    return np.asarray(slopes.T @ slopes)


def _slopes(fit: Fit, *, without: int | None) -> Array:
    """Jacobian of all trials but one and of the prior, one below the other."""
    seen = [jacobian for i, jacobian in enumerate(fit.jacobian) if i != without]
    return np.vstack([*seen, np.diag(fit.coordinates.weights), _FAINT * np.eye(fit.x.size)])


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
    trace of J C J', with C the covariance of the parameters without the trial, of those
    that are not held by a bound.
    """
    moved, explained = 0.0, 0.0
    low, high = fit.coordinates.bounds()
    for i, (jacobian, step) in enumerate(zip(fit.jacobian, _steps(fit), strict=True)):
        there = fit.x + step
        known = _open(fit)
        known = known[(there > low + _AT_BOUND)[known] & (there < high - _AT_BOUND)[known]]
        spread = np.linalg.pinv(information(fit, without=i)[np.ix_(known, known)])
        moved += float(np.sum((jacobian @ step) ** 2))
        explained += float(np.sum((jacobian[:, known] @ spread) * jacobian[:, known]))
    return moved / explained if explained > 0 else 0.0


def _open(fit: Fit) -> NDArray[np.int_]:
    """Entries that are found again without a trial."""
    return np.array([i for i, o in enumerate(fit.coordinates.owners) if o not in CONVENTIONS], int)


def _steps(fit: Fit) -> list[Array]:
    """How the parameters move without each trial: the least squares of the others, within bounds."""
    known = _open(fit)
    found = [np.zeros(fit.x.size) for _ in fit.by_trial]
    if known.size and len(fit.by_trial) > 1:
        for i, step in enumerate(found):
            step[known] = _bounded(fit, known, i)
    return found


def _bounded(fit: Fit, known: NDArray[np.int_], without: int) -> Array:
    """The step of some entries that the other trials ask for."""
    seen = [residual for i, residual in enumerate(fit.by_trial) if i != without]
    left = np.concatenate([*seen, fit.coordinates.weights * fit.x, np.zeros(fit.x.size)])
    basis, root = np.linalg.qr(_slopes(fit, without=without)[:, known])
    low, high = (np.asarray(bound - fit.x)[known] for bound in fit.coordinates.bounds())
    return least_squares(root, -basis.T @ left, low, high)

"""Cross-validation: what a fit predicts on trials that it has not seen.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial is simulated with them. Which rate the tissue
resists is a convention of the rig, not a finding: it stays as fitted.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.bounded_least_squares import bounded_least_squares
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.nuisance import CONVENTIONS
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import predict, residuals
from diagnosis.workers import side_by_side

Array = NDArray[np.float64]

_AT_BOUND = 1e-6  # from a bound, in the units of the fit
_RIDGE = 3e-5  # on what nothing else tells


def information(fit: Fit, *, without: int | None = None) -> Array:
    """J'J with the prior, over all trials but one: the inverse covariance of the parameters."""
    slopes = _slopes(fit, without=without)
    return np.asarray(slopes.T @ slopes)


def _slopes(fit: Fit, *, without: int | None) -> Array:
    """Jacobian of all trials but one and of the prior, one below the other."""
    seen = [jacobian for i, jacobian in enumerate(fit.jacobian) if i != without]
    return np.vstack([*seen, np.diag(fit.parameterization.weights), _RIDGE * np.eye(fit.x.size)])


def held_out_residuals(problem: FitProblem, fit: Fit) -> tuple[Array, ...]:
    """Residuals / sigma of each trial, simulated with what the others say.

    Raises:
      SimulationFailed: the others lead to where the needle cannot be simulated.
    """

    def left(trial: PreparedTrial, step: Array) -> Array:
        rig = fit.parameterization.rig(fit.x + step)
        prediction = predict(problem.log.rig, trial, [rig], problem.resolution)[0]
        return residuals(trial, prediction, problem.noise)

    each = list(zip(problem.log.trials, _steps(fit), strict=True))
    return tuple(side_by_side(lambda pair: left(*pair), each))


def shift_statistic(fit: Fit) -> float:
    """How far predictions of held-out trials move, over what noise in the parameters explains.

    About 1 or less where all trials tell the same: sum of |J step|^2 over that of the
    trace of J C J', with C the covariance of the parameters without the trial, of those
    that are not held by a bound.
    """
    moved, explained = 0.0, 0.0
    low, high = fit.parameterization.bounds()
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
    return np.array([i for i, o in enumerate(fit.parameterization.owners) if o not in CONVENTIONS], int)


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
    left = np.concatenate([*seen, fit.parameterization.weights * fit.x, np.zeros(fit.x.size)])
    basis, root = np.linalg.qr(_slopes(fit, without=without)[:, known])
    low, high = (np.asarray(bound - fit.x)[known] for bound in fit.parameterization.bounds())
    return bounded_least_squares(root, -basis.T @ left, low, high)

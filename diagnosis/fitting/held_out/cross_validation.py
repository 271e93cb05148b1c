"""Cross-validation: predictions of a fit on trials that it has not seen.

Each trial is left out in turn: one Gauss-Newton step on the others moves the
parameters, and the left-out trial is simulated with them. Which rate the tissue
resists is a convention of the rig, not a result, and the clock of a sensor may run off by
another rate in each trial: both stay as fitted. What concerns one trial alone, as the past of one
that began late, is fitted there, with the other parameters from the others.
"""

import numpy as np
from numpy.typing import NDArray

from diagnosis.cores import side_by_side
from diagnosis.fitting.bounded_least_squares import bounded_least_squares
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.nuisance import CONVENTIONS
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import predict, residuals

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
    """Residuals / sigma of each trial, simulated with the parameters from the others.

    Raises:
      SimulationFailed: the needle cannot be simulated with the parameters from the others.
    """

    def left(trial: PreparedTrial, step: Array) -> Array:
        rig = fit.parameterization.rig(fit.x + step)
        prediction = predict(problem.log.rig, trial, [rig], problem.resolution)[0]
        return residuals(trial, prediction, problem.noise)

    each = list(zip(problem.log.trials, _steps(fit), strict=True))
    return tuple(side_by_side(lambda pair: left(*pair), each))


def shift_statistic(fit: Fit) -> float:
    """Change of the predictions of held-out trials / change that parameter noise explains.

    About 1 or less if all trials are consistent: sum of |J step|^2 / sum of trace(J C J'), with C
    the covariance, without the trial, of the parameters that are not at a bound.
    """
    moved, explained = 0.0, 0.0
    low, high = fit.parameterization.bounds()
    for i, step in enumerate(_steps(fit)):
        there = fit.x + step
        known = told_by_others(fit, i)
        known = known[(there > low + _AT_BOUND)[known] & (there < high - _AT_BOUND)[known]]
        spread = np.linalg.pinv(information(fit, without=i)[np.ix_(known, known)])
        slopes = slopes_by(fit, i, known)
        moved += float(np.sum((fit.jacobian[i] @ step) ** 2))
        explained += float(np.sum((slopes @ spread) * slopes))
    return moved / explained if explained > 0 else 0.0


def _own(fit: Fit, trial: int) -> NDArray[np.int_]:
    """Indices of entries that affect this trial only."""
    seen = fit.jacobian[trial].any(axis=0)
    return np.flatnonzero(fit.parameterization.about_one_trial & seen)


def told_by_others(fit: Fit, trial: int) -> NDArray[np.int_]:
    """Indices of entries that are fitted again without a trial."""
    own = fit.parameterization
    as_fitted = {*CONVENTIONS, *(effect.name for effect in own.all if effect.differs)}
    found = np.array([owner not in as_fitted for owner in own.owners], bool)
    found[_own(fit, trial)] = False
    return np.flatnonzero(found)


def slopes_by(fit: Fit, trial: int, known: NDArray[np.int_]) -> Array:
    """Derivative of a trial's residual by these entries, its own ones answering, (N, known)."""
    own = fit.jacobian[trial][:, _own(fit, trial)]
    return np.asarray(fit.jacobian[trial][:, known] + own @ _answers(fit, trial, known))


def with_own_answers(fit: Fit, trial: int, others: Array) -> Array:
    """The vector that a fit to the other trials has found, with a trial's own entries fitted to it."""
    known, own, found = told_by_others(fit, trial), _own(fit, trial), others.copy()
    found[own] = fit.x[own] + _answers(fit, trial, known) @ (others - fit.x)[known]
    return np.clip(found, *fit.parameterization.bounds())


def _answers(fit: Fit, trial: int, known: NDArray[np.int_]) -> Array:
    """Derivative of a trial's own entries by the others, (own, known): least squares on the trial."""
    own = _own(fit, trial)
    slopes = np.vstack([fit.jacobian[trial][:, own], np.diag(fit.parameterization.weights[own])])
    moved = np.vstack([fit.jacobian[trial][:, known], np.zeros((own.size, known.size))])
    return np.asarray(-np.linalg.pinv(slopes) @ moved)


def _steps(fit: Fit) -> list[Array]:
    """Steps of the parameters without each trial: least squares on the others, within bounds."""
    found = [np.zeros(fit.x.size) for _ in fit.by_trial]
    for i, step in enumerate(found):
        known = told_by_others(fit, i)
        if known.size and len(found) > 1:
            step[known] = _bounded(fit, known, i)
            step[:] = with_own_answers(fit, i, fit.x + step) - fit.x
    return found


def _bounded(fit: Fit, known: NDArray[np.int_], without: int) -> Array:
    """The step of some entries by least squares on the other trials, within bounds."""
    seen = [residual for i, residual in enumerate(fit.by_trial) if i != without]
    left = np.concatenate([*seen, fit.parameterization.weights * fit.x, np.zeros(fit.x.size)])
    basis, root = np.linalg.qr(_slopes(fit, without=without)[:, known])
    low, high = (np.asarray(bound - fit.x)[known] for bound in fit.parameterization.bounds())
    return bounded_least_squares(root, -basis.T @ left, low, high)

"""Fits of a set of effects to a log, together with the nuisance parameters.

A fit minimises

    sum over trials and sensors ((measured - predicted) / sigma)^2 + prior

by MuJoCo's own box-bounded Gauss-Newton; the columns of one Jacobian run as a batch.
"""

import io
from collections.abc import Collection, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SCATTER
from diagnosis.effects import FITTED
from diagnosis.fitting.bounded_least_squares import bounded_least_squares, predicted_reduction
from diagnosis.fitting.fit_status import Ended, FitStatus, Stopping, Termination, far_for
from diagnosis.fitting.objective import NearStart, Objective
from diagnosis.fitting.parameterization import Parameterization, parameterization_of
from diagnosis.fitting.problem import FitProblem

Array = NDArray[np.float64]

_GRADIENT_TOLERANCE = 0.02  # in sigma
_STEP_TOLERANCE = 1e-5
_MOST_ITERATIONS = 20


@dataclass(frozen=True, kw_only=True, eq=False)
class Fit:
    """A fitted set of effects.

    Attributes:
      names: names of the effects.
      x: the vector, (n,); `parameterization` gives the meaning of its entries.
      by_trial: residuals / sigma, one array per trial.
      jacobian: d residual / d x, one (N, n) array per trial.
      cost: sum of squares, including the prior.
      status: how the optimiser ended.
    """

    names: tuple[str, ...]
    parameterization: Parameterization
    x: Array
    by_trial: tuple[Array, ...]
    jacobian: tuple[Array, ...]
    cost: float
    status: FitStatus

    @property
    def samples(self) -> int:
        """Number of residuals."""
        return sum(r.size for r in self.by_trial)

    @property
    def gap(self) -> float:
        """Root mean square of residual / sigma, on the data of the fit."""
        return float(np.sqrt(sum(float(r @ r) for r in self.by_trial) / max(self.samples, 1)))

    @property
    def size(self) -> int:
        """Number of parameters of the named effects."""
        return sum(len(FITTED[n].reported) for n in self.names)

    @property
    def prior(self) -> float:
        """Cost of the prior alone."""
        return float(np.sum((self.parameterization.weights * self.x) ** 2))

    @cached_property
    def predicted_cost(self) -> float:
        """Cost that one more step would leave, by the linear model."""
        low, high = self.parameterization.bounds()
        return self.cost - predicted_reduction(self.slopes, self.residual, low - self.x, high - self.x)

    @property
    def next_step(self) -> Array:
        """The step that would come next, by the linear model, (n,); hardly any if converged."""
        low, high = self.parameterization.bounds()
        return bounded_least_squares(self.slopes, -self.residual, low - self.x, high - self.x)

    def with_its_prediction(self) -> "Fit":
        """The fit, whose predicted cost is computed now: by the process that made it."""
        _ = self.predicted_cost
        return self

    @property
    def residual(self) -> Array:
        """Residuals and prior, one below the other, (N,)."""
        return np.concatenate([*self.by_trial, self.parameterization.weights * self.x])

    @property
    def slopes(self) -> Array:
        """Jacobian of residuals and prior, one below the other, (N, n)."""
        return np.vstack([*self.jacobian, np.diag(self.parameterization.weights)])

    @property
    def parts(self) -> dict[str, Array]:
        """The vector by effect."""
        return self.parameterization.parts(self.x)

    @property
    def constants_at_bound(self) -> tuple[str, ...]:
        """Stiffness and damping, where not named, that stopped at a bound, as effect.parameter."""
        told = [f"{e.name}.{p.name}" for e in self.parameterization.all for p in e.parameters]
        mine = [owner in SCATTER and owner not in self.names for owner in self.parameterization.owners]
        held = self.parameterization.held(self.x)
        return tuple(name for name, at, own in zip(told, held, mine, strict=True) if at and own)

    @property
    def trial_at_bound(self) -> bool:
        """Whether what concerns one trial only, as its past does, stopped at a bound."""
        return bool(np.any(self.parameterization.held(self.x) & self.parameterization.about_one_trial))


def fit_effects(
    problem: FitProblem,
    names: Sequence[str],
    start: Array | None = None,
    enough: float = np.inf,
    *,
    most_iterations: int = _MOST_ITERATIONS,
    slopes: Array | None = None,
    near: NearStart | None = None,
    from_a_fit: bool = False,
    to_the_end: bool = False,
) -> Fit:
    """Fit a set of effects.

    Args:
      start: the vector to start from; None: neutral.
      enough: cost below which the fit is of use; it is given up if it cannot get there.
      most_iterations: largest number of Gauss-Newton iterations.
      slopes: Jacobian of residuals and prior, (N, n), from a similar fit; None: it is computed.
      near: what is known about the start; None: it is simulated.
      from_a_fit: whether it starts where another fit ended: finite differences are small at once.
      to_the_end: whether it goes on where it is slow far above the noise.

    Raises:
      SimulationFailed: the rig cannot be simulated at the start, or near a later iterate.
    """
    parameterization = problem.parameterization(names)
    objective = Objective(problem, parameterization)
    if not parameterization.parameters:
        return nominal_fit(
            [trial[0] for trial in problem.residuals([parameterization.rig(np.zeros(0))])]
        )
    x = np.clip(parameterization.joined({}) if start is None else start, objective.low, objective.high)
    differences = max((e.differences for e in parameterization.all), key=len)
    for difference in differences[-1:] if from_a_fit or slopes is not None else differences:
        objective = Objective(problem, parameterization, difference, slopes)
        if near is not None:  # with the next difference, the fit is no longer at its start
            objective.learn_from(x, near)
            near = None
        far = np.inf if to_the_end else far_for(leading=problem.callback_alone)
        stopping = Stopping(objective, problem.tolerance_sigma, enough, far=far)
        x, status = _minimised(objective, x, stopping, most_iterations)
        if status.termination is Termination.BEHIND:
            break
    return _fit(objective, names, x, replace(status, at_bound=_at_bound(parameterization, x)))


def fit_left_at(problem: FitProblem, names: Sequence[str], x: Array) -> Fit:
    """The "fit" of a set of effects that is left where it starts, with its slopes there.

    Raises:
      SimulationFailed: the rig cannot be simulated there, or near it.
    """
    objective = Objective(problem, problem.parameterization(names))
    objective.jacobian(x, objective(x))
    status = FitStatus(termination=Termination.NOTHING_TO_FIT, message="left where it starts")
    return _fit(objective, names, x, status)


def change_without(problem: FitProblem, fit: Fit, effects: Collection[str]) -> float:
    """Sum of squares / sigma^2 of what some effects of a fit add to its others.

    Raises:
      SimulationFailed: the rig without them cannot be simulated.
    """
    names = [name for name in fit.names if name not in effects]
    nuisance = [own for own in fit.parameterization.nuisance if own.name not in effects]
    without = parameterization_of(names, nuisance, problem.library, problem.base)
    kept = {own.name: fit.parts[own.name] for own in fit.parameterization.all if own.name not in effects}
    each = zip(problem.residuals([without.rig(without.joined(kept))]), fit.by_trial, strict=True)
    return float(sum(np.sum((run[0] - left) ** 2) for run, left in each))


def completed(problem: FitProblem, fit: Fit) -> Fit:
    """A fit that was given up, taken on to its end; any other as it is.

    Raises:
      SimulationFailed: as `fit_effects`.
    """
    if not fit.status.ended_early:
        return fit
    return fit_effects(problem, fit.names, fit.x, from_a_fit=True, to_the_end=True)


def nominal_fit(by_trial: Sequence[Array]) -> Fit:
    """The fit without effects, from the residuals / sigma of the nominal rig."""
    return Fit(
        names=(),
        parameterization=parameterization_of(()),
        x=np.zeros(0),
        by_trial=tuple(by_trial),
        jacobian=tuple(np.zeros((r.size, 0)) for r in by_trial),
        cost=sum(float(r @ r) for r in by_trial),
        status=FitStatus(termination=Termination.NOTHING_TO_FIT, message="nothing to fit"),
    )


def _minimised(
    objective: Objective, start: Array, stopping: Stopping, most_iterations: int
) -> tuple[Array, FitStatus]:
    """The result of Gauss-Newton from a start, and how it ended."""
    said = io.StringIO()
    try:
        x, _ = minimize.least_squares(
            start,
            stopping,
            bounds=[objective.low, objective.high],
            jacobian=stopping.jacobian,
            x_scale="jac",
            gtol=_GRADIENT_TOLERANCE,
            xtol=_STEP_TOLERANCE,
            max_iter=most_iterations,
            mu_min=0.01,  # a shorter step that is no other step is not worth a simulation
            mu_factor=8.0,
            verbose=minimize.Verbosity.FINAL,
            output=said,
            iter_callback=stopping.after_step,
        )
    except Ended as ended:
        return ended.x, FitStatus(termination=ended.termination, message=str(ended))
    return np.asarray(x).ravel(), FitStatus.of_message(said.getvalue())


def _at_bound(parameterization: Parameterization, x: Array) -> tuple[str, ...]:
    """Parameters of the named effects that stopped at a bound, as effect.parameter."""
    names = [f"{e.name}.{p.name}" for e in parameterization.effects for p in e.parameters]
    return tuple(name for name, at in zip(names, parameterization.held(x), strict=False) if at)


def _fit(objective: Objective, names: Sequence[str], x: Array, status: FitStatus) -> Fit:
    """The fit at x; its slopes are those of the last iterate."""
    by_trial = objective.at_the_end(x)
    ends = np.cumsum([r.size for r in by_trial])
    prior = objective.parameterization.weights * x
    slopes = np.zeros((ends[-1], x.size)) if objective.slopes is None else objective.slopes
    return Fit(
        names=tuple(names),
        parameterization=objective.parameterization,
        x=x,
        by_trial=by_trial,
        jacobian=tuple(np.split(slopes[: ends[-1]], ends[:-1])),
        cost=sum(float(r @ r) for r in by_trial) + float(prior @ prior),
        status=status,
    )

"""How a fit ends: by the optimiser's own criteria, because it has converged, or because it is hopeless.

At every Jacobian J the linear model predicts that the cost S = |r|^2 of N residuals may still fall by

    P = S - min |r + J dx|^2,    dx within bounds of the p parameters.

converged   sqrt(P / p) <= tolerance * sqrt(S / (N - p)), the relative offset of Bates and Watts (1981):
            parameters are within so many of their own standard deviations of the minimum. Within
            five times the tolerance one more step is taken, without another Jacobian.
far         at two Jacobians in turn, S > F N and P < (S - N) / 20: such steps do not lead down to the
            noise. F is 3 in fits that only tell which to do again, and the limit of the floor in others.
behind      S - 10 P is above the cost that a fit has to reach to be of use; from the third Jacobian on
            S - 5 P: of 365 later Jacobians 95 in 100 were followed by a gain of at most that, half of
            them by one of P, and the others were in slow valleys, far above the noise.
creeping    at the noise, two steps in turn take off less than a quarter of what was promised, and P is
            less than half of the least lead that any decision asks for: of 114 fits three did so, and
            what further steps took off was at most P. Fits that go to their end do not end so.
stalled     no step along the search direction reduces the cost: shorter ones would be below a hundredth
            of the finite difference, at which slopes are meaningless.

If a model leaves a large residual, finite differences cannot give a gradient that is small compared with
noise: its error grows with the residual. The relative offset is therefore relative to the residual.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

import numpy as np
from mujoco import minimize
from numpy.typing import NDArray

from diagnosis.criteria.fitting import GAP_LIMIT
from diagnosis.criteria.selection import NEAR_FLOOR, NESTED_LEAD
from diagnosis.fitting.bounded_least_squares import predicted_reduction
from diagnosis.fitting.objective import Objective

Array = NDArray[np.float64]

_ONE_MORE = 5.0  # tolerances within which one more step is enough
_DAMPED = 0.1  # regularizer from which a step is no Gauss-Newton step
_SLOW = 0.05  # of what is left beyond noise: what a step takes off at most
_FUTILE, _FUTILE_LATER = 10.0, 5.0  # times what the linear model promises; from the third Jacobian on
_CREEPING = 0.25  # share of the promise that a step keeps at least
_LITTLE = 0.5 * NESTED_LEAD  # cost that decides nothing
_IDLE_SIGMA = 0.1  # by which a parameter changes the residuals over its range, as a norm
_MOST_TRIES = 8  # steps along one direction, each shorter
_SHORT = 0.01  # differences that slopes were taken over: a shorter step is beyond them


class Termination(StrEnum):
    """Why a fit ended."""

    GRADIENT = "converged: gradient"
    STEP = "converged: step"
    OFFSET = "converged: relative offset"
    STALLED = "stalled: no further reduction"
    CREEPING = "stopped: at the noise, and slow"
    ITERATIONS = "stopped: most iterations"
    FAR = "stopped: far above the noise, and slow"
    BEHIND = "stopped: cannot come near the best"
    FACTORIZATION = "failed: factorization"
    NOTHING_TO_FIT = "nothing to fit"
    OTHER = "other"


# What the messages of mujoco.minimize contain.
_MUJOCO = {
    "norm(gradient) < tol": Termination.GRADIENT,
    "norm(dx) < tol": Termination.STEP,
    "insufficient reduction": Termination.STALLED,
    "maximum iterations": Termination.ITERATIONS,
    "factorization failed": Termination.FACTORIZATION,
}
_COUNT = re.compile(r"Terminated after (\d+)")

_MEANING = {
    Termination.GRADIENT: "converged after {}: the residual has no slope left along any parameter",
    Termination.STEP: "converged after {}: the next step is too small to matter",
    Termination.OFFSET: "converged after {}: a further step would change no parameter by more than a "
    "small part of its uncertainty",
    Termination.STALLED: "ended after {}: no further step lowers the residual; the values are the best "
    "that were found, and others close by may fit as well",
    Termination.CREEPING: "ended after {}: further steps hardly lower the residual; others close by fit "
    "as well",
    Termination.ITERATIONS: "ended after {}, the most that are allowed: more might lower the residual",
    Termination.FAR: "ended after {}: far above the noise, with little to gain by further steps",
    Termination.BEHIND: "given up after {}: it cannot come near the best explanations",
    Termination.FACTORIZATION: "failed after {}: no next step can be computed; do not use the values",
}


def in_words(termination: Termination, iterations: int) -> str:
    """How a fit ended, and what this means for its values, in words."""
    count = f"{iterations} iteration{'' if iterations == 1 else 's'}"
    return _MEANING[termination].format(count)


@dataclass(frozen=True, kw_only=True)
class FitStatus:
    """The end of a fit.

    Attributes:
      message: the end in words, and what it means for the values.
      at_bound: parameters that stopped at a bound, as effect.parameter.
    """

    termination: Termination
    message: str
    at_bound: tuple[str, ...] = ()

    @property
    def converged(self) -> bool:
        """Whether the optimiser met its tolerance."""
        return self.termination in (
            Termination.GRADIENT,
            Termination.STEP,
            Termination.OFFSET,
            Termination.NOTHING_TO_FIT,
        )

    @property
    def ended_early(self) -> bool:
        """Whether it was given up, with values that are not those of the minimum."""
        return self.termination in (Termination.FAR, Termination.BEHIND)

    @classmethod
    def of_message(cls, said: str, at_bound: tuple[str, ...] = ()) -> "FitStatus":
        """The status from the optimiser's last message."""
        count = _COUNT.search(said)
        termination = next((end for words, end in _MUJOCO.items() if words in said), Termination.OTHER)
        if count is None or termination is Termination.OTHER:
            return cls(termination=Termination.OTHER, message=said.strip(), at_bound=at_bound)
        message = in_words(termination, int(count[1]))
        return cls(termination=termination, message=message, at_bound=at_bound)


class Ended(Exception):
    """Raised at the end of a fit: with the vector, and the reason."""

    def __init__(self, x: Array, termination: Termination, iterations: int) -> None:
        super().__init__(in_words(termination, iterations))
        self.x, self.termination = x, termination


def far_for(*, leading: bool) -> float:
    """Cost per sample above which slow fits end: those that only tell which to do again, or others."""
    return NEAR_FLOOR if leading else GAP_LIMIT**2


class Stopping:
    """An objective that can end its own minimisation, by raising `Ended`."""

    def __init__(
        self,
        objective: Objective,
        tolerance: float,
        enough: float = np.inf,
        *,
        far: float = np.inf,
    ) -> None:
        """Wrap an objective.

        Args:
          tolerance: relative offset at which the fit has converged.
          enough: cost below which the fit is of use.
          far: cost per sample above which it ends where steps are promised to take off hardly anything;
            infinite: it goes to its end.
        """
        self.objective, self.tolerance, self.enough = objective, tolerance, enough
        self.far = far
        self._there = self._tried = np.zeros(0)
        self._tries = self._jacobians = 0
        self._last = self._slow = False
        self._before = (np.inf, np.inf)
        self._crept = 0

    def __call__(self, x: Array) -> Array:
        """Residuals with the prior, (N,)."""
        if self._last and self._tries == 1:
            raise self._ended(self._there, Termination.OFFSET)
        if self._tries == _MOST_TRIES or (self._tries and self._is_short(x.ravel() - self._there)):
            raise self._ended(self._there, Termination.STALLED)
        self._tries += 1
        self._tried = x.ravel().copy()
        return self.objective(x)

    def jacobian(self, x: Array, at_x: Array) -> Array:
        """Jacobian of residuals and prior, (N, n)."""
        slopes = self.objective.jacobian(x, at_x)
        self._there, self._tries = x.ravel().copy(), 0
        self._jacobians += 1
        cost, predicted = float(at_x.ravel() @ at_x.ravel()), self._predicted_cost(at_x.ravel(), slopes)
        futile = _FUTILE if self._jacobians == 2 else _FUTILE_LATER
        if self._jacobians > 1 and cost - futile * predicted > self.enough:
            raise self._ended(self._there, Termination.BEHIND)
        freedom = slopes.shape[1]
        noise = cost / max(at_x.size - freedom, 1)
        offset = np.sqrt(max(predicted, 0.0) / (freedom * noise)) if noise > 0 else 0.0
        if offset <= self.tolerance:
            raise self._ended(self._there, Termination.OFFSET)
        if self._creeps(cost, predicted, at_x.size):
            raise self._ended(self._there, Termination.CREEPING)
        slow = cost > self.far * at_x.size and predicted < _SLOW * (cost - at_x.size)
        if slow and self._slow:
            raise self._ended(self._there, Termination.FAR)
        self._slow = slow
        self._last = bool(offset <= _ONE_MORE * self.tolerance)
        return self._without_idle(slopes)

    def _creeps(self, cost: float, predicted: float, samples: int) -> bool:
        """Whether two steps in turn took off little of what the model promised, which is little now."""
        before, promised = self._before
        self._before = cost, predicted
        self._crept = self._crept + 1 if 0.0 < before - cost < _CREEPING * promised else 0
        if math.isinf(self.far):  # it goes to its end
            return False
        return self._crept > 1 and predicted < _LITTLE and cost <= GAP_LIMIT**2 * samples

    def _without_idle(self, slopes: Array) -> Array:
        """Slopes, 0 along parameters that change nothing here, whatever they are.

        The optimiser would send such a one across its whole range, and shorten the steps of all others
        when that leaves more.
        """
        reach = np.linalg.norm(slopes, axis=0) * (self.objective.high - self.objective.low)
        return np.where(reach < _IDLE_SIGMA, 0.0, slopes)

    def after_step(self, trace: Sequence[minimize.IterLog]) -> None:
        """Called by `mujoco.minimize` after every step that reduced the cost."""
        if self._last and trace[-1].reduction > 0 and trace[-1].regularizer < _DAMPED:
            raise self._ended(self._tried, Termination.OFFSET, more=1)

    def _is_short(self, step: Array) -> bool:
        return bool(np.abs(step).max(initial=0.0) < _SHORT * self.objective.difference)

    def _ended(self, x: Array, termination: Termination, more: int = 0) -> Ended:
        """The end after as many steps as there were Jacobians before this one, plus `more`."""
        return Ended(x, termination, self._jacobians - 1 + more)

    def _predicted_cost(self, residual: Array, slopes: Array) -> float:
        """Reduction of the cost that the linear model predicts, within bounds."""
        low, high = self.objective.low - self._there, self.objective.high - self._there
        return predicted_reduction(slopes, residual, low, high)

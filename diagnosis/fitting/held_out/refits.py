"""Held-out trials, each predicted by a fit to the others, if one step from the fit is not enough."""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import FAR_STEP
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.held_out.cross_validation import held_out_residuals, with_own_answers
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.stopping import StoppedEarly

Array = NDArray[np.float64]
GapOf = Callable[[Fit, tuple[Array, ...]], float]

_ITERATIONS = 3
_TOLERANCE_SIGMA = 0.2


def plain_gap(_: Fit, held_out: tuple[Array, ...]) -> float:
    """Root mean square of held-out residuals / sigma."""
    return floor_of(held_out).gap


def held_out_or_refitted(problem: FitProblem, fit: Fit, gap_of: GapOf = plain_gap) -> tuple[Array, ...]:
    """Residuals / sigma of trials that the fit has not seen: by one step, or by refits if there is time.

    Args:
      gap_of: gap of a fit's held-out residuals; if it is far above that of the fit, refits are made.

    Raises:
      SimulationFailed: the needle cannot be simulated with the parameters from the others.
    """
    held_out = held_out_residuals(problem, fit)
    if gap_of(fit, held_out) <= FAR_STEP * fit.gap:
        return held_out
    try:
        return refitted_without(problem, fit)
    except StoppedEarly:
        return held_out


def refitted_without(problem: FitProblem, fit: Fit) -> tuple[Array, ...]:
    """Residuals / sigma of each trial, simulated with a fit to the others.

    These fits take the slopes of the fit to all trials: no simulation per parameter and step. They end
    within a fifth of a standard deviation, which changes no gap by more than its noise.

    Raises:
      SimulationFailed: the needle cannot be simulated with the parameters from the others.
    """
    left, weights = [], np.diag(fit.parameterization.weights)
    for i, trial in enumerate(problem.log.trials):
        others = tuple(other for j, other in enumerate(problem.log.trials) if j != i)
        slopes = np.vstack([*(own for j, own in enumerate(fit.jacobian) if j != i), weights])
        rest = replace(
            problem, log=replace(problem.log, trials=others), tolerance_sigma=_TOLERANCE_SIGMA
        )
        again = fit_effects(rest, fit.names, fit.x, most_iterations=_ITERATIONS, slopes=slopes)
        rig = again.parameterization.rig(with_own_answers(fit, i, again.x))
        own = replace(problem, log=replace(problem.log, trials=(trial,)))
        left.append(own.residuals([rig])[0][0])
    return tuple(left)

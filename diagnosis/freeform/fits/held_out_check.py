"""A free-form law fitted to the log itself, and checked on trials that the fit has not seen."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import LAW_OPEN
from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.held_out.cross_validation import slopes_by, told_by_others
from diagnosis.fitting.held_out.refits import held_out_or_refitted
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.prior import free_covariance
from sim.needles.run import SimulationFailed

Array = NDArray[np.float64]

FINAL_ITERATIONS = 5  # from the end on the decimated log: what is right gets there in three
FINAL_SIGMA = 0.1  # tolerance: a curve has a band of two of these
FAR_ITERATIONS = 3


def fitted_and_checked(
    problem: FitProblem, contender: FreeFit, start: Array, *, far: bool = False
) -> FreeFit:
    """The family of a contender, fitted to the log itself and checked on trials that it has not seen.

    Args:
      far: whether it leaves far more than noise: it is not fitted to its end, and checked by runs half
        as fine.
    """
    own = with_family(problem, *contender.families)
    own = replace(own, differences_halved=True, tolerance_sigma=FINAL_SIGMA)
    iterations = FAR_ITERATIONS if far else FINAL_ITERATIONS
    fit = fit_effects(own, contender.names, start, most_iterations=iterations)
    if len(problem.log.trials) == 1:
        return replace(contender, fit=fit, gap_after=fit.gap, final=True)
    try:
        held_out = held_out_or_refitted(own.of_differences if far else own, fit, predictive_gap)
    except SimulationFailed:
        return replace(contender, fit=fit, gap_after=np.inf, final=True)
    gap = max(predictive_gap(fit, held_out), fit.gap)
    return replace(contender, fit=fit, held_out=held_out, gap_after=gap, final=True)


def predictive_gap(fit: Fit, held_out: Sequence[Array]) -> float:
    """Root mean square of residuals of held-out trials over their predictive standard deviation.

    That is the noise and what the other trials leave open of the curve: where none of them has been,
    its law says nothing, and nothing is held against it. Of a law that they determine it is the gap.
    """
    squares = [left**2 / (1.0 + left_open(fit, i)) for i, left in enumerate(held_out)]
    return float(np.sqrt(np.mean(np.concatenate(squares))))


def share_determined(one: FreeFit) -> float:
    """Share of the readings for which trials other than their own tell the law; 1 for a single trial."""
    if one.held_out is None:
        return 1.0
    return float(
        np.mean(np.concatenate([determined_by_others(one.fit, i) for i in range(len(one.held_out))]))
    )


def determined_by_others(fit: Fit, trial: int) -> NDArray[np.bool_]:
    """Residuals of a trial for which the other trials tell the law, to less than the noise, (N,)."""
    return np.asarray(left_open(fit, trial) <= LAW_OPEN)


def left_open(fit: Fit, trial: int) -> Array:
    """Variance of a trial's prediction that the other trials leave open, in that of the noise, (N,)."""
    known = told_by_others(fit, trial)
    slopes = slopes_by(fit, trial, known)
    spread = free_covariance(fit, without=trial)[np.ix_(known, known)]
    return np.asarray(np.sum((slopes @ spread) * slopes, axis=1))

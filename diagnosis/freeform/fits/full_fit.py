"""A contender fitted to its end on the decimated log, with the strength of its priors estimated."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit, fit_effects
from diagnosis.fitting.objective import NearStart
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.prior import with_estimated_prior
from diagnosis.selection.screening import screen

Array = NDArray[np.float64]

ITERATIONS, FIRST_ITERATIONS = 10, 4


def begun_only(
    coarse: FitProblem, contender: FreeFit, enough: float = np.inf, start: Array | None = None
) -> FreeFit:
    """Fitted for the first iterations; the arguments are those of `full_fit`."""
    own = with_family(coarse, *contender.families)
    fit = _fitted(own, contender, enough, start, FIRST_ITERATIONS)
    return replace(contender, fit=fit.with_its_prediction(), gap_after=fit.gap)


def full_fit(
    coarse: FitProblem, contender: FreeFit, enough: float = np.inf, start: Array | None = None
) -> FreeFit:
    """Fitted twice, unless given up: then with the strength of priors that the first fit speaks for.

    Args:
      enough: cost below which it is of use.
      start: the vector to start from; None: where the fit of the contender, or screening, ended.
    """
    own, names = with_family(coarse, *contender.families), contender.names
    fit = _fitted(own, contender, enough, start, ITERATIONS)
    if fit.status.ended_early:
        return replace(contender, fit=fit, gap_after=fit.gap)
    family, *others = (with_estimated_prior(f, fit) for f in contender.families)
    own, near = with_family(coarse, family, *others), near_its_end(fit, by_trial=True)
    fit = fit_effects(
        own, names, fit.x, enough, most_iterations=ITERATIONS // 2, near=near, from_a_fit=True
    )
    return replace(contender, family=family, others=tuple(others), fit=fit, gap_after=fit.gap)


def near_its_end(fit: Fit, *, by_trial: bool = False) -> NearStart | None:
    """What a fit says of one that starts where it ended; None: it has no slopes.

    Args:
      by_trial: whether the residuals are the same, too.
    """
    slopes = np.vstack(fit.jacobian)
    return (
        NearStart(slopes=slopes, by_trial=fit.by_trial if by_trial else None) if slopes.any() else None
    )


def _fitted(
    own: FitProblem, contender: FreeFit, enough: float, start: Array | None, iterations: int
) -> Fit:
    """From a start, or with the slopes of its fit where that has all laws."""
    if start is None and contender.fit.names == contender.names:
        x, near = contender.fit.x, near_its_end(contender.fit)
        ended = near is not None
        return fit_effects(
            own, contender.names, x, enough, most_iterations=iterations, near=near, from_a_fit=ended
        )
    start = _start(own, contender) if start is None else start
    return fit_effects(own, contender.names, start, enough, most_iterations=iterations)


def _start(problem: FitProblem, contender: FreeFit) -> Array:
    """The vector of its fit, with what screening says of a law that this does not have."""
    *_, last = contender.families
    if last.name in contender.fit.names:
        return contender.fit.x
    best = screen(problem, contender.fit, last.name)[0]
    parts = problem.parameterization(best.names).parts(best.start)
    return problem.parameterization(contender.names).joined(parts)

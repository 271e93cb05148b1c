"""A contender fitted to its end on the decimated log, with the strength of its priors estimated."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.free_fit import FreeFit, with_family
from diagnosis.freeform.prior import with_estimated_prior
from diagnosis.selection.screening import screen

Array = NDArray[np.float64]

ITERATIONS = 10


def to_its_end(
    coarse: FitProblem, contender: FreeFit, enough: float = np.inf, start: Array | None = None
) -> FreeFit:
    """Fitted twice, unless given up: then with the strength of priors that the first fit speaks for.

    Args:
      enough: cost below which it is of use.
      start: the vector to start from; None: where the fit of the contender, or screening, ended.
    """
    own, names = with_family(coarse, *contender.families), contender.names
    start = _start(own, contender) if start is None else start
    fit = fit_effects(own, names, start, enough, most_iterations=ITERATIONS)
    if fit.status.ended_early:
        return replace(contender, fit=fit, gap_after=fit.gap)
    family, *others = (with_estimated_prior(f, fit) for f in contender.families)
    own = with_family(coarse, family, *others)
    fit = fit_effects(own, names, fit.x, enough, most_iterations=ITERATIONS // 2)
    return replace(contender, family=family, others=tuple(others), fit=fit, gap_after=fit.gap)


def _start(problem: FitProblem, contender: FreeFit) -> Array:
    """The vector of its fit, with what screening says of a law that this does not have."""
    *_, last = contender.families
    if last.name in contender.fit.names:
        return contender.fit.x
    best = screen(problem, contender.fit, last.name)[0]
    parts = problem.parameterization(best.names).parts(best.start)
    return problem.parameterization(contender.names).joined(parts)

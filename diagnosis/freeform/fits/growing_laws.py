"""Which laws grow with another variable, if none closes the gap as it is.

By a linear model of the law and its factor at once, whose slopes take a simulation for each coordinate
of the factor; those that promise most are fitted.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.family import Family
from diagnosis.freeform.fits.free_fit import FreeFit, each_fit, few_of_each, with_family
from diagnosis.freeform.fits.full_fit import full_fit
from diagnosis.freeform.fits.growth_factor import all_grown, may_grow
from diagnosis.freeform.fits.laws_beside import predicted_score
from diagnosis.freeform.ranges import LogRanges
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]

SCREENING, GROWING = "screening free-form laws that grow", "free-form laws that grow"
LEADING = 8  # laws that may grow
GROWN, GROWN_OF_ONE = 6, 2  # that are fitted, in all and of one law
_STEP = 0.05  # of a coordinate of a factor


def growing(
    coarse: FitProblem,
    laws: Sequence[FreeFit],
    ranges: LogRanges,
    workers: Workers,
) -> list[FreeFit]:
    """Fits of laws that grow.

    Args:
      laws: fits of laws alone that leave different things, those that leave least first.
    """
    may = [law for law in laws if may_grow(law.fit.parameterization.rig(law.fit.x).free)][:LEADING]
    pairs = [(law, family) for law in may for family in all_grown(law.family, ranges)]
    tasks = [Task(effects=(), arguments=(coarse, law, family)) for law, family in pairs]
    each = zip(pairs, workers.each(SCREENING, score_of_growing, tasks), strict=True)
    predicted = [(score, pair) for pair, score in each if not isinstance(score, Failure)]
    ranked = (pair for _, pair in sorted(predicted, key=lambda one: one[0]))
    kept = islice(few_of_each(ranked, lambda pair: pair[0], GROWN_OF_ONE), GROWN)
    enough = min((law.fit.cost for law in laws), default=np.inf)
    calls = [
        (coarse, replace(law, family=family), enough, start_of(coarse, law, family))
        for law, family in kept
    ]
    return each_fit(GROWING, full_fit, calls, workers)


def start_of(coarse: FitProblem, law: FreeFit, family: Family) -> Array:
    """The vector of the law that does not grow."""
    more = len(family.effect.parameters) - len(law.family.effect.parameters)
    parts = law.fit.parts
    own = np.append(parts[law.family.name], np.zeros(more))
    parameterization = with_family(coarse, family).parameterization((family.name,))
    return parameterization.joined({**parts, family.name: own})


def score_of_growing(coarse: FitProblem, law: FreeFit, family: Family) -> float:
    """The score that the law could come to if it grew."""
    problem = with_family(coarse, family)
    parameterization = problem.parameterization((family.name,))
    start = start_of(coarse, law, family)
    new = np.arange(len(law.family.effect.parameters), len(family.effect.parameters))
    rigs = [parameterization.rig(start + _STEP * one) for one in np.eye(start.size)[new]]
    each = zip(problem.residuals(rigs, callback_alone=True), law.fit.by_trial, strict=True)
    slopes = np.concatenate([(np.stack(own, axis=1) - was[:, None]) / _STEP for own, was in each])
    return predicted_score(law.fit, slopes, parameterization.weights[new])

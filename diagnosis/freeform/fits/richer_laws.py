"""Which laws need a finer curve, and, if none closes the gap as it is, which grow with another variable.

By a linear model of the law and the detail of its curve, or its factor, at once, whose slopes take a
simulation for each new coordinate; those that promise most are fitted.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import islice

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.families import families_of
from diagnosis.freeform.family import KINDS, Family, kind_of
from diagnosis.freeform.fits.free_fit import FreeFit, each_fit, few_of_each, with_family
from diagnosis.freeform.fits.full_fit import full_fit
from diagnosis.freeform.fits.growth_factor import all_grown, may_grow
from diagnosis.freeform.fits.laws_beside import predicted_score
from diagnosis.freeform.ranges import LogRanges
from diagnosis.workers import Failure, Task, Workers

Array = NDArray[np.float64]

SCREENING, FITTING = "screening richer free-form laws", "richer free-form laws"
LEADING = 8  # laws that may grow, or be finer
RICHER, RICHER_OF_ONE = 6, 2  # that are fitted, in all and of one law
_STEP = 0.05  # of a new coordinate


def richer(
    coarse: FitProblem,
    laws: Sequence[FreeFit],
    ranges: LogRanges,
    workers: Workers,
    *,
    growing: bool,
) -> list[FreeFit]:
    """Fits of laws that have a finer curve, or grow.

    Args:
      laws: fits of laws alone that leave different things, those that leave least first.
      ranges: of these laws.
      growing: whether they may grow; if not, those alone are fitted whose finer curve promises more.
    """
    finer = {family.name: family for family in families_of(ranges.in_more_detail)}
    may = [(law, [*(_grown(law, ranges) if growing else ()), *_finer(law, finer)]) for law in laws]
    leading = [one for one in may if one[1]][:LEADING]
    pairs = [(law, family) for law, families in leading for family in families]
    tasks = [Task(effects=(), arguments=(coarse, law, family)) for law, family in pairs]
    each = zip(pairs, workers.each(SCREENING, score_of_richer, tasks), strict=True)
    scored = [(score, pair) for pair, score in each if not isinstance(score, Failure)]
    predicted = [(score, pair) for score, pair in scored if growing or score < pair[0].score]
    ranked = (pair for _, pair in sorted(predicted, key=lambda one: one[0]))
    kept = islice(few_of_each(ranked, lambda pair: pair[0], RICHER_OF_ONE), RICHER)
    enough = min((law.fit.cost for law in laws), default=np.inf)
    calls = [
        (coarse, replace(law, family=family), enough, start_of(coarse, law, family))
        for law, family in kept
    ]
    return each_fit(FITTING, full_fit, calls, workers)


def _grown(law: FreeFit, ranges: LogRanges) -> tuple[Family, ...]:
    """The families of a law that grows; empty: it may not."""
    grows = may_grow(law.fit.parameterization.rig(law.fit.x).free)
    return all_grown(law.family, ranges) if grows else ()


def _finer(law: FreeFit, finer: Mapping[str, Family]) -> tuple[Family, ...]:
    """The family of a law with a finer curve and its priors, by its name; empty: there is none."""
    family = finer.get(law.family.name, law.family)
    known = {kind_of(p): p.prior_sigma for p in law.family.effect.parameters}
    more = len(family.effect.parameters) > len(law.family.effect.parameters)
    return (family.with_prior({kind: known.get(kind, 1.0) for kind in KINDS}),) if more else ()


def start_of(coarse: FitProblem, law: FreeFit, family: Family) -> Array:
    """The vector of the law as it is, without growth or detail."""
    more = len(family.effect.parameters) - len(law.family.effect.parameters)
    parts = law.fit.parts
    own = np.append(parts[law.family.name], np.zeros(more))
    parameterization = with_family(coarse, family).parameterization((family.name,))
    return parameterization.joined({**parts, family.name: own})


def score_of_richer(coarse: FitProblem, law: FreeFit, family: Family) -> float:
    """The score that the law could come to if it were of the richer family."""
    problem = with_family(coarse, family)
    parameterization = problem.parameterization((family.name,))
    start = start_of(coarse, law, family)
    new = np.arange(len(law.family.effect.parameters), len(family.effect.parameters))
    rigs = [parameterization.rig(x) for x in (start, *(start + _STEP * np.eye(start.size)[new]))]
    each = [np.stack(own, axis=1) for own in problem.residuals(rigs, callback_alone=True)]
    slopes = np.concatenate([(own[:, 1:] - own[:, :1]) / _STEP for own in each])
    return predicted_score(law.fit, slopes, parameterization.weights[new])

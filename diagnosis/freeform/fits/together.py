"""Laws fitted together with others, if none alone closes the gap.

A law that is not in the list may come near as the sum, or the product, of some that are. The pairs that
promise most are fitted, of two laws and of a law and an effect of the library; if none of these closes
the gap, the best have one law more.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.beside import pairs_beside
from diagnosis.freeform.fits.free_fit import FreeFit, each_fit
from diagnosis.freeform.fits.laws_beside import laws_beside
from diagnosis.freeform.fits.to_its_end import to_its_end
from diagnosis.workers import Workers

PAIRS, THREE = "free-form laws in pairs and beside an effect", "three free-form laws"
LEADING, LEADING_PAIRS = 12, 2  # fits beside which another law is looked for: of one law, of several
_SAME = 1e-4  # in sigma; of a cost


def beside_one(
    coarse: FitProblem,
    base: Fit,
    fitted: Sequence[FreeFit],
    first: Sequence[FreeFit],
    effects: Sequence[str],
    workers: Workers,
) -> list[FreeFit]:
    """Fits of one law with an effect of the library, or with another law."""
    alone = distinct([*fitted, *first])
    with_effects = [
        (coarse, replace(law, beside=found.names[-1:]), _least(fitted), found.start)
        for law, found in pairs_beside(coarse, base, alone, effects, workers)
    ]
    pairs = laws_beside(base, unlike(alone)[:LEADING], first)
    with_laws = [(coarse, pair, _least(fitted)) for pair in pairs]
    return each_fit(PAIRS, to_its_end, [*with_effects, *with_laws], workers)


def beside_several(
    coarse: FitProblem,
    base: Fit,
    fitted: Sequence[FreeFit],
    first: Sequence[FreeFit],
    workers: Workers,
) -> list[FreeFit]:
    """Fits of the best pairs with one law more, unless a law alone is as good as these."""
    best = unlike(sorted(fitted, key=lambda f: f.score))[:LEADING_PAIRS]
    pairs = [f for f in best if len(f.names) > 1]
    calls = [(coarse, more, _least(fitted)) for more in laws_beside(base, pairs, first)]
    return each_fit(THREE, to_its_end, calls, workers)


def _least(fits: Sequence[FreeFit]) -> float:
    """Their least cost: more of a law beside another would be of no use."""
    return min(f.fit.cost for f in fits)


def distinct(ranked: Sequence[FreeFit]) -> list[FreeFit]:
    """The best fit of each family."""
    best: dict[str, FreeFit] = {}
    for f in ranked:
        best.setdefault(f.family.name, f)
    return list(best.values())


def unlike(ranked: Sequence[FreeFit]) -> list[FreeFit]:
    """Those that leave something else than each before them; variables may be the same in a log."""
    kept: list[FreeFit] = []
    for f in ranked:
        if not any(_leave_the_same(f.fit, k.fit) for k in kept):
            kept.append(f)
    return kept


def _leave_the_same(one: Fit, other: Fit) -> bool:
    if not np.isclose(one.cost, other.cost, rtol=_SAME):
        return False
    each = zip(one.by_trial, other.by_trial, strict=True)
    return all(np.allclose(own, left, rtol=0.0, atol=_SAME) for own, left in each)

"""Laws fitted together with others, if none alone closes the gap.

A law that is not in the list may come near as the sum, or the product, of some that are. The pairs that
promise most are fitted, of two laws and of a law and an effect of the library; if none of these closes
the gap, the best have one law more. All are fitted for a rougher needle first, a quarter of the cost,
for a few iterations; the most promising pairs to their end there; the best on the decimated log.
"""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.effects_beside import pairs_beside
from diagnosis.freeform.fits.free_fit import FreeFit, each_fit
from diagnosis.freeform.fits.full_fit import begun_only, full_fit
from diagnosis.freeform.fits.laws_beside import laws_beside
from diagnosis.workers import Workers

PAIRS, THREE = "free-form laws in pairs and beside an effect", "three free-form laws"
LEADING, LEADING_PAIRS = 12, 2  # fits beside which another law is looked for: of one law, of several
WORTH_AN_END, WORTH_MORE, THREE_WORTH_MORE = 6, 3, 2  # of those for a rougher needle
_SAME = 1e-4  # in sigma; of a cost


def beside_one(
    coarse: FitProblem,
    rough: FitProblem,
    base: Fit,
    fitted: Sequence[FreeFit],
    first: Sequence[FreeFit],
    effects: Sequence[str],
    workers: Workers,
) -> list[FreeFit]:
    """Fits of one law with an effect of the library, or with another law.

    Args:
      rough: the decimated log for a rougher needle.
    """
    alone, least = distinct([*fitted, *first]), _least(fitted)
    with_effects = [
        (rough, replace(law, beside=found.names[-1:]), least, found.start)
        for law, found in pairs_beside(coarse, rough, base, alone, effects, workers)
    ]
    pairs = laws_beside(base, unlike(alone)[:LEADING], first)
    with_laws = [(rough, pair, least) for pair in pairs]
    begun = _begun(PAIRS, [*with_effects, *with_laws], workers)
    roughly = _ended(PAIRS, rough, begun[:WORTH_AN_END], least, workers)
    return _ended(PAIRS, coarse, roughly[:WORTH_MORE], least, workers)


def beside_several(
    coarse: FitProblem,
    rough: FitProblem,
    base: Fit,
    fitted: Sequence[FreeFit],
    first: Sequence[FreeFit],
    workers: Workers,
) -> list[FreeFit]:
    """Fits of the best pairs with one law more, unless a law alone is as good as these."""
    best = unlike(sorted(fitted, key=lambda f: f.score))[:LEADING_PAIRS]
    pairs = [f for f in best if len(f.names) > 1]
    least = _least(fitted)
    begun = _begun(THREE, [(rough, more, least) for more in laws_beside(base, pairs, first)], workers)
    return _ended(THREE, coarse, begun[:THREE_WORTH_MORE], least, workers)


def _begun(stage: str, calls: Sequence[tuple[Any, ...]], workers: Workers) -> list[FreeFit]:
    """Fits that calls begin for a rougher needle, most promising first."""
    return sorted(each_fit(stage, begun_only, calls, workers), key=lambda f: f.predicted_score)


def _ended(
    stage: str, problem: FitProblem, fits: Sequence[FreeFit], enough: float, workers: Workers
) -> list[FreeFit]:
    """Fits of a problem from where others ended, best first."""
    calls = [(problem, f, enough) for f in fits]
    return sorted(each_fit(stage, full_fit, calls, workers), key=lambda f: f.score)


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
    """Those that leave something else than each before them; variables may be the same in a log.

    Of laws that leave the same, the one whose place is surest stands for all, in the places of all:
    an offset of the drive in each trial is one of the tip's reading.
    """
    kept: list[FreeFit] = []
    for f in ranked:
        same = next((i for i, k in enumerate(kept) if _leave_the_same(f.fit, k.fit)), None)
        if same is None:
            kept.append(f)
        else:
            kept[same] = _in_the_places_of_both(kept[same], f)
    return kept


def _in_the_places_of_both(one: FreeFit, other: FreeFit) -> FreeFit:
    """The one whose place is surest, the first if both are, with the mean of both probabilities."""
    each = [f.family.places for f in (one, other)]
    if each[0] == each[1]:
        return one
    surest = max((one, other), key=lambda f: max(f.family.places.values()))
    places = {p: float(np.mean([own.get(p, 0.0) for own in each])) for p in {**each[0], **each[1]}}
    return replace(surest, family=replace(surest.family, places=places))


def _leave_the_same(one: Fit, other: Fit) -> bool:
    if not np.isclose(one.cost, other.cost, rtol=_SAME):
        return False
    each = zip(one.by_trial, other.by_trial, strict=True)
    return all(np.allclose(own, left, rtol=0.0, atol=_SAME) for own, left in each)

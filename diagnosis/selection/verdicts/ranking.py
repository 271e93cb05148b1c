"""Probabilities of all explanations of a log: exp(-score / 2), normalised."""

import math
from collections.abc import Sequence

from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.verdicts.rivals import certain_lead

NOTHING, UNEXPLAINED = "none", "unknown"
"""What a ranking has beside effects: the nominal rig, and what the library does not hold."""


def ranking_of(
    candidates: Sequence[Candidate], best: Candidate | None
) -> tuple[tuple[tuple[str, ...], float], ...]:
    """Probabilities of all explanations, also of what was not worth a fit; a set of effects is one.

    Args:
      best: what the verdict names; None: what explains the log is unknown.
    """
    found: dict[tuple[str, ...], float] = {(n,): 0.0 for n in (*LIBRARY, NOTHING, UNEXPLAINED)}
    if best is None:
        found[UNEXPLAINED,] = 1.0
    else:
        found |= {named or (NOTHING,): p for named, p in _probabilities(candidates, best).items()}
    return tuple(sorted(found.items(), key=lambda item: -item[1]))


def _probabilities(candidates: Sequence[Candidate], best: Candidate) -> dict[tuple[str, ...], float]:
    """Of sets of effects: exp(-score / 2), normalised; fits of one set add up.

    By what the best with more beside it would have to lead to be named counts against it. Of another
    one only that counts by which the best leads for certain.
    """
    weights = dict[tuple[str, ...], float]()
    reached = min(c.score for c in (best, *candidates) if {*c.named} == {*best.named})
    scores = [
        reached + certain_lead(best, c, reached) + c.lead_over_part * _has_more(c, best)
        for c in candidates
    ]
    least = min(scores)
    for c, score in zip(candidates, scores, strict=True):
        named = tuple(sorted(c.named))
        weights[named] = weights.get(named, 0.0) + math.exp(-0.5 * min(score - least, 1400.0))
    return {named: weight / sum(weights.values()) for named, weight in weights.items()}


def _has_more(one: Candidate, best: Candidate) -> bool:
    return bool(best.named) and set(best.named) < set(one.named)

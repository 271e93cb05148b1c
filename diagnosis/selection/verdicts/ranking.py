"""Probabilities of all explanations of a log: exp(-score / 2), normalised."""

import math
from collections.abc import Sequence

from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate

NOTHING, UNEXPLAINED = "none", "unknown"
"""What a ranking has beside effects: the nominal rig, and what the library does not hold."""


def ranking_of(
    candidates: Sequence[Candidate], *, known: bool
) -> tuple[tuple[tuple[str, ...], float], ...]:
    """Probabilities of all explanations, also of what was not worth a fit; a set of effects is one."""
    found: dict[tuple[str, ...], float] = {(n,): 0.0 for n in (*LIBRARY, NOTHING, UNEXPLAINED)}
    if known:
        found |= {named or (NOTHING,): p for named, p in _probabilities(candidates).items()}
    else:
        found[UNEXPLAINED,] = 1.0
    return tuple(sorted(found.items(), key=lambda item: -item[1]))


def _probabilities(candidates: Sequence[Candidate]) -> dict[tuple[str, ...], float]:
    """Of sets of effects: exp(-score / 2), normalised; fits of one set add up."""
    least, weights = min(c.score for c in candidates), dict[tuple[str, ...], float]()
    for c in candidates:
        named = tuple(sorted(c.named))
        weights[named] = weights.get(named, 0.0) + math.exp(-0.5 * min(c.score - least, 1400.0))
    return {named: weight / sum(weights.values()) for named, weight in weights.items()}

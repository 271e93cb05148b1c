"""From ranked candidates to a verdict that says no more than the data do.

none        the nominal rig is at the noise floor, or what is left of it is the rig's
            own scatter in stiffness and damping
explained   the best candidate is at the noise floor and nothing else comes near it
undecided   another candidate, not a richer relative of the best, fits alike
unknown     nothing that was tried brings the residual to the noise floor
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum

from diagnosis.candidate import Candidate
from diagnosis.effects import LIBRARY

# A difference of score of 10 is odds of 150 to 1 for data with the noise that is assumed.
ALIKE = 10.0
# What an effect that contains another has to lead that by. Where the simple one is true it leads by
# what freedom costs, 2 log(samples), about 18, less a chi-square of two: it is behind by 5 once in
# 100 000 logs, and ahead by less than 10, which is undecided, twice in 100.
NESTED = 5.0


class Outcome(StrEnum):
    """The four verdicts."""

    NONE = "none"
    EXPLAINED = "explained"
    UNKNOWN = "unknown"
    UNDECIDED = "undecided"


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What was concluded.

    Attributes:
      effects: accepted, strongest first.
      confusable: sets of effects that fit alike.
      best: the candidate that predictions and parameters are of.
      rivals: candidates that explain the log as well as the best.
      ranking: single effects, none and unknown with probabilities that add up to 1.
    """

    outcome: Outcome
    effects: tuple[str, ...]
    confusable: tuple[tuple[str, ...], ...]
    best: Candidate
    rivals: tuple[Candidate, ...] = ()
    ranking: tuple[tuple[str, float], ...]

    @property
    def settled(self) -> bool:
        """Whether the log is explained, be it by nothing."""
        return self.outcome in (Outcome.NONE, Outcome.EXPLAINED)


def judge(candidates: Sequence[Candidate]) -> Verdict:
    """The verdict on candidates, best first."""
    at_floor = _explaining(candidates)
    if not at_floor:
        return Verdict(
            outcome=Outcome.UNKNOWN,
            effects=(),
            confusable=(),
            best=candidates[0],
            ranking=_ranking(candidates, known=False),
        )
    best = _simplest(at_floor)
    rivals = [c for c in at_floor if c is not best and _alike(best, c)]
    outcome = Outcome.NONE if not best.named else Outcome.EXPLAINED
    if rivals and outcome is Outcome.EXPLAINED:
        outcome = Outcome.UNDECIDED
    return Verdict(
        outcome=outcome,
        effects=best.named,
        confusable=tuple(tuple(c.named) for c in (best, *rivals)) if rivals else (),
        best=best,
        rivals=tuple(rivals),
        ranking=_ranking(candidates, known=True),
    )


def _explaining(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Candidates at the floor, but for effects that add nothing to a rig that is off itself."""
    torn = min((c.score for c in candidates if c.torn and c.floor.reached), default=math.inf)
    return [c for c in candidates if c.explains and (c.score < torn or c.of_scatter or not c.leans)]


def _simplest(at_floor: Sequence[Candidate]) -> Candidate:
    """The simplest of those that score within reach of the best."""
    best = at_floor[0]
    near = [c for c in at_floor if c.score - best.score <= ALIKE]
    simplest = min(near, key=lambda c: (len(c.named), c.fit.size, c.score))
    leads = simplest.score - best.score
    return best if _nested(best, simplest) and leads > NESTED else simplest


def _alike(best: Candidate, other: Candidate) -> bool:
    """Whether another explanation fits as well, and is not the best with more beside it."""
    if not best.named or not other.named or abs(other.score - best.score) > ALIKE:
        return False
    if _nested(best, other):
        return best.fit.size < other.fit.size  # the other way round, NESTED is enough
    return not _covers(other, best)


def _nested(one: Candidate, other: Candidate) -> bool:
    """Whether they differ in one effect, which is a special case of the other's."""
    mine, theirs = set(one.named) - set(other.named), set(other.named) - set(one.named)
    if len(mine) != 1 or len(theirs) != 1:
        return False
    a, b = mine.pop(), theirs.pop()
    return a in LIBRARY[b].contains or b in LIBRARY[a].contains


def _covers(other: Candidate, best: Candidate) -> bool:
    """Whether each effect of the best is there, or contained in one that is."""
    within = {name for o in other.named for name in (o, *LIBRARY[o].contains)}
    return set(best.named) <= within


def _ranking(candidates: Sequence[Candidate], *, known: bool) -> tuple[tuple[str, float], ...]:
    """Probabilities of single effects, none and unknown: exp(-score / 2), normalised."""
    weights = dict.fromkeys((*LIBRARY, "none", "unknown"), 0.0)
    if not known:
        weights["unknown"] = 1.0
    else:
        least = min(c.score for c in candidates)
        for c in candidates:
            weight = math.exp(-0.5 * min(c.score - least, 1400.0))
            for name in c.named or ("none",):
                weights[name] += weight / max(len(c.named), 1)
    total = sum(weights.values())
    ranked = sorted(weights.items(), key=lambda item: -item[1])
    return tuple((name, weight / total) for name, weight in ranked)


def places(effects: Sequence[str]) -> str:
    """Where the first of the accepted effects lives."""
    return LIBRARY[effects[0]].place.value if effects else ""

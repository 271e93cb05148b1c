"""From ranked candidates to a verdict that says no more than the data do.

none        the nominal rig is at the noise floor, or what is left of it is the rig's
            own scatter in stiffness and damping
explained   the best candidate is at the noise floor and nothing else comes near it, but for what
            asks the rig's constants to be off by chance
undecided   another candidate, not a richer relative of the best, fits alike
unknown     nothing that was tried brings the residual to the noise floor
"""

import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

from diagnosis.criteria import (
    CLEAR_SHIFT,
    EQUAL_SCORE,
    NEARLY,
    NESTED_LEAD,
    NOMINAL_LEAD,
    PART_LEAD,
    SHIFT_LIMIT,
    SIMPLE_LEAD,
)
from diagnosis.effects import FITTED, IMPERFECTIONS, LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.delay_or_filter import lags_little, takes_for_a_filter

NOTHING, UNEXPLAINED = "none", "unknown"
"""What a ranking has beside effects: the nominal rig, and what the library does not hold."""


class VerdictKind(StrEnum):
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
      confusable: sets of effects that fit alike, the accepted one first.
      best: the candidate that predictions and parameters are of.
      rivals: candidates that explain the log as well as the best.
      ranking: explanations with probabilities that add up to 1, most probable first: every effect of
        the library alone, sets of several that were fitted, `NOTHING` and `UNEXPLAINED`.
      other_form: free-form law that leaves clearly less than the best, in plain words; empty: none is
        known.
    """

    kind: VerdictKind
    effects: tuple[str, ...]
    confusable: tuple[tuple[str, ...], ...]
    best: Candidate
    rivals: tuple[Candidate, ...] = ()
    ranking: tuple[tuple[tuple[str, ...], float], ...]
    other_form: str = ""

    @property
    def settled(self) -> bool:
        """Whether the log is explained, be it by nothing."""
        return self.kind in (VerdictKind.NONE, VerdictKind.EXPLAINED)


def verdict_on(candidates: Sequence[Candidate]) -> Verdict:
    """The verdict on candidates, best first.

    One whose parameters are at a bound, or as good as none, explains nothing; but where it leads what
    does, that is open. And so it is where a part of it is likelier, but above the floor; or is hardly
    less likely, and shifts from trial to trial or is above the floor by a hair, or samples are means.
    """
    at_floor = _without_needless_scatter(_explaining(candidates))
    if not at_floor:
        return Verdict(
            kind=VerdictKind.UNKNOWN,
            effects=(),
            confusable=(),
            best=_first_of_equals(candidates),
            ranking=_ranking(candidates, known=False),
        )
    best = _simplest(at_floor)
    reached = min(c.score for c in at_floor if set(c.named) == set(best.named))
    alike = [c for c in at_floor if c.score - reached <= SIMPLE_LEAD and _alike(best, c)]
    late = [c for c in candidates if takes_for_a_filter(best, c) and _may_be_it(best, c, reached)]
    alike += [c for c in late if c not in alike]
    leading = [
        c for c in candidates if c.score < reached and (_alike(best, c) or _clearly_leads(c, reached))
    ]
    refused = [
        c for c in leading if c.refused_for_values or _is_part(c, best) or _is_richer_but_shifts(c, best)
    ]
    refused += [c for c in candidates if c not in alike and _hardly_led(c, best, reached)]
    rivals = sorted((*refused, *alike), key=lambda c: _less_likely(best, c, reached))
    kind = VerdictKind.NONE if not best.named else VerdictKind.EXPLAINED
    if rivals and not (best.named and all(_less_likely(best, c, reached) for c in rivals)):
        kind = VerdictKind.UNDECIDED
    return Verdict(
        kind=kind,
        effects=best.named,
        confusable=distinct(tuple(c.named) for c in (best, *rivals)) if rivals else (),
        best=best,
        rivals=tuple(rivals),
        ranking=_ranking((*at_floor, *refused), known=True),
    )


def provisional(verdict: Verdict, candidates: Sequence[Candidate]) -> Verdict:
    """The verdict of a search that was cut short: no more than what was tried can say.

    An explanation at the noise floor may have rivals that nobody tried, and the nominal rig effects
    that nobody looked for. So it is `undecided` between all that explain the log so far, that of the
    verdict first, or `unknown`.

    Args:
      candidates: that were checked, best first.
    """
    if verdict.kind is VerdictKind.UNKNOWN:
        return verdict
    others = [c for c in candidates if c.explains and c is not verdict.best]
    confusable = distinct((verdict.effects, *(c.named for c in others), *verdict.confusable))
    return replace(verdict, kind=VerdictKind.UNDECIDED, confusable=confusable, rivals=tuple(others))


def distinct(sets: Iterable[tuple[str, ...]]) -> tuple[tuple[str, ...], ...]:
    """Sets of effects, each once, as it is first named."""
    found: dict[frozenset[str], tuple[str, ...]] = {}
    for names in sets:
        found.setdefault(frozenset(names), names)
    return tuple(found.values())


def with_open_effects(verdict: Verdict, effects: Sequence[str]) -> Verdict:
    """The verdict where effects may be there, or not: what is allowed for does the same as they.

    Args:
      effects: none of the verdict's own.
    """
    if verdict.kind is VerdictKind.UNKNOWN or not effects:
        return verdict
    told = verdict.confusable or (verdict.effects,)
    beside = tuple((*names, *effects) for names in told)
    shares = dict(verdict.ranking)
    for names, both in zip(told, beside, strict=True):
        alone, wider = tuple(sorted(names)) or (NOTHING,), tuple(sorted(both))
        shares[alone] = 0.5 * shares.get(alone, 0.0)
        shares[wider] = shares.get(wider, 0.0) + shares[alone]
    ranking = tuple(sorted(shares.items(), key=lambda item: -item[1]))
    return replace(verdict, kind=VerdictKind.UNDECIDED, confusable=(*told, *beside), ranking=ranking)


def refuted(verdict: Verdict, form: str) -> Verdict:
    """The verdict where a law that no library holds leaves clearly less than the explanation.

    Args:
      form: of that law, in plain words.
    """
    return Verdict(
        kind=VerdictKind.UNKNOWN,
        effects=(),
        confusable=(),
        best=verdict.best,
        ranking=_ranking((), known=False),
        other_form=form,
    )


def _explaining(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Candidates at the floor, but for effects that add nothing to a rig that is off itself."""
    alone = min(
        (c.score for c in candidates if not _effects(c) and c.jointly_significant and c.floor.reached),
        default=math.inf,
    )
    return [
        c
        for c in candidates
        if c.explains and (c.score <= alone or c.only_scatter or not c.jointly_significant)
        if not any(_shifts_without_imperfections(c, other) for other in candidates)
    ]


def _shifts_without_imperfections(one: Candidate, other: Candidate) -> bool:
    """Whether it is another one with imperfections that nothing asks for but its shift over trials.

    With more freedom the same change of the parameters is less of a shift.
    """
    same = {*other.names} < {*one.names} and {*other.named} == {*one.named} and other.floor.reached
    return same and other.score <= one.score and other.shift > CLEAR_SHIFT * other.shift_limit


def _effects(one: Candidate) -> tuple[str, ...]:
    """Effects that it has, beside imperfections of sensors."""
    return tuple(name for name in one.names if name not in IMPERFECTIONS)


def _without_needless_scatter(at_floor: Sequence[Candidate]) -> list[Candidate]:
    """Candidates, the exact nominal rig in place of one with scatter that hardly fits better."""
    nominal = [c for c in at_floor if not c.names]
    exact = next((c for c in nominal if not c.fit.x.size), None)
    if exact is None or exact.fit.cost > min(c.fit.cost for c in nominal) + NOMINAL_LEAD:
        return list(at_floor)
    kept = replace(exact, score=min(c.score for c in nominal))
    return sorted((kept, *(c for c in at_floor if c.names)), key=lambda c: c.score)


def _first_of_equals(candidates: Sequence[Candidate]) -> Candidate:
    """The likeliest; of those that the log cannot tell from it, always the same one.

    Where a needle never slides, dry friction and that which depends on the speed are one.
    """
    equal = (c for c in candidates if c.score - candidates[0].score <= EQUAL_SCORE)
    return min(equal, key=lambda c: (len(c.names), sorted(c.names)))


def _simplest(at_floor: Sequence[Candidate]) -> Candidate:
    """Of the fewest effects among those within reach of the best; of the simplest form that does.

    Nothing is the answer only where it is the likeliest one.
    """
    best = at_floor[0]
    near = [c for c in at_floor if c.score - best.score <= SIMPLE_LEAD and (_says(c) or c is best)]
    fewest = min(near, key=lambda c: (len(c.named), c.score))
    forms = (c for c in near if _nested(fewest, c) and c.fit.size < fewest.fit.size)
    return next((c for c in forms if c.score - fewest.score <= NESTED_LEAD), fewest)


def _alike(best: Candidate, other: Candidate) -> bool:
    """Whether another explanation says something else, and is not the best with more beside it.

    An effect may be taken for an imperfection of a sensor, so that these count here.
    """
    if not _says(best):
        return False
    if set(best.named) == set(other.named):
        return False
    if _nested(best, other):
        return best.fit.size < other.fit.size  # the other way round, NESTED_LEAD is enough
    return not _covers(other, best)


def _is_part(one: Candidate, best: Candidate) -> bool:
    """Whether it is the best without some of its effects, and not at the noise floor."""
    return {*one.names} < {*best.names} and not one.floor.reached


def _may_be_it(best: Candidate, late: Candidate, reached: float) -> bool:
    """Whether a delay in place of the filters of the best is led by what a replay may not resolve.

    Where the best says nothing else, any delay at the floor may be the one cause that there is.

    Args:
      reached: score of the best.
    """
    near = late.explains and late.score - reached <= PART_LEAD
    return near or (not best.named and late.floor.reached)


def _clearly_leads(one: Candidate, reached: float) -> bool:
    """Whether an explanation at a bound leads by more than what a replay may not resolve.

    Args:
      reached: score of the best.
    """
    return bool(one.reached_bounds) and one.refused_for_values and reached - one.score > PART_LEAD


def _is_richer_but_shifts(one: Candidate, best: Candidate) -> bool:
    """Whether it is a richer form of the best that would explain the log, but for shifting trials."""
    richer = _nested(best, one) and best.fit.size < one.fit.size
    return richer and one.floor.reached and one.shift > one.shift_limit


def _hardly_led(one: Candidate, best: Candidate, reached: float) -> bool:
    """Whether it is a part of the best that is led by what a replay may not resolve.

    That is at the floor, or above it by a hair.

    Args:
      reached: score of the best.
    """
    part = {*one.names} < {*best.names} and one.floor.within(NEARLY) and _says(one) != ()
    part = part and {*one.named} != {*best.named}  # else only an imperfection of a sensor is doubtful
    doubtful = one.shift > SHIFT_LIMIT or one.of_means or not one.floor.reached
    more = len(best.names) - len(one.names)
    return part and doubtful and one.score - reached <= more * PART_LEAD


def _less_likely(best: Candidate, other: Candidate, reached: float) -> bool:
    """Whether less of a lead than SIMPLE_LEAD decides, so that the other is only named beside the best.

    It is a richer form of the best, which the data do not ask for; or behind by what stiffness and
    damping would have to be off for it, which is known and no noise; or a delay for a filter that does
    little.

    Args:
      reached: score of the best.
    """
    richer = _nested(best, other) and best.fit.size < other.fit.size
    more_scatter = other.fit.prior - best.fit.prior > NESTED_LEAD and other.score > best.score
    behind = richer and other.score - reached > NESTED_LEAD
    return more_scatter or behind or lags_little(best, other)


def _nested(one: Candidate, other: Candidate) -> bool:
    """Whether they differ in one effect, which is a special case of the other's."""
    mine, theirs = set(one.named) - set(other.named), set(other.named) - set(one.named)
    if len(mine) != 1 or len(theirs) != 1:
        return False
    a, b = mine.pop(), theirs.pop()
    return a in FITTED[b].contains or b in FITTED[a].contains


def _covers(other: Candidate, best: Candidate) -> bool:
    """Whether each effect of the best is there, or contained in one that is."""
    within = {name for o in _says(other) for name in (o, *FITTED[o].contains)}
    return set(_says(best)) <= within


def _says(one: Candidate) -> tuple[str, ...]:
    """What is named, and imperfections of sensors."""
    return (*one.named, *(name for name in one.names if name in IMPERFECTIONS))


def _probabilities(candidates: Sequence[Candidate]) -> dict[tuple[str, ...], float]:
    """Of sets of effects: exp(-score / 2), normalised; fits of one set add up."""
    least, weights = min(c.score for c in candidates), dict[tuple[str, ...], float]()
    for c in candidates:
        named = tuple(sorted(c.named))
        weights[named] = weights.get(named, 0.0) + math.exp(-0.5 * min(c.score - least, 1400.0))
    return {named: weight / sum(weights.values()) for named, weight in weights.items()}


def _ranking(
    candidates: Sequence[Candidate], *, known: bool
) -> tuple[tuple[tuple[str, ...], float], ...]:
    """Probabilities of all explanations, also of what was not worth a fit; a set of effects is one."""
    found: dict[tuple[str, ...], float] = {(n,): 0.0 for n in (*LIBRARY, NOTHING, UNEXPLAINED)}
    if known:
        found |= {named or (NOTHING,): p for named, p in _probabilities(candidates).items()}
    else:
        found[UNEXPLAINED,] = 1.0
    return tuple(sorted(found.items(), key=lambda item: -item[1]))


def places(effects: Sequence[str]) -> str:
    """Where the first of the accepted effects lives."""
    return LIBRARY[effects[0]].place.value if effects else ""

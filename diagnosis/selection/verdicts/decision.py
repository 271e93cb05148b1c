"""From ranked candidates to a verdict that says no more than the data do."""

import math
from collections.abc import Sequence
from dataclasses import replace

from diagnosis.criteria.freeform import FAR_GAP, PLAINER_LEAVES
from diagnosis.criteria.selection import (
    CLEAR_SHIFT,
    EQUAL_SCORE,
    NESTED_LEAD,
    NOMINAL_LEAD,
    SIMPLE_LEAD,
)
from diagnosis.effects import IMPERFECTIONS
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.verdicts.delay_or_filter import takes_for_a_filter
from diagnosis.selection.verdicts.ranking import ranking_of
from diagnosis.selection.verdicts.rivals import (
    certain_lead,
    clearly_leads,
    differ_in_one_form,
    hardly_led,
    is_part,
    is_richer_but_shifts,
    less_likely,
    may_be_it,
    says,
    says_something_else,
)
from diagnosis.selection.verdicts.verdict import Verdict, VerdictKind, distinct


def verdict_on(candidates: Sequence[Candidate]) -> Verdict:
    """The verdict on candidates, best first.

    One whose parameters are at a bound, or as good as none, explains nothing; but where it leads what
    does, that is open. (Where nothing does, one that is as good as none has nothing to imitate.) And so
    it is where a part of it is likelier, but above the floor; or is hardly less likely, and shifts from
    trial to trial or is above the floor by a hair, or samples are means.
    """
    at_floor = _without_needless_scatter(_explaining(candidates))
    at_floor = at_floor or [c for c in candidates if c.refused_as_none]
    if not at_floor:
        return _unknown(candidates)
    best = _simplest(at_floor)
    reached = min(c.score for c in at_floor if set(c.named) == set(best.named))
    alike = _alike(candidates, at_floor, best, reached)
    refused = _refused(candidates, alike, best, reached)
    rivals = sorted((*refused, *alike), key=lambda c: less_likely(best, c, reached))
    return Verdict(
        kind=_kind(best, rivals, reached),
        effects=best.named,
        confusable=distinct(tuple(c.named) for c in (best, *rivals)) if rivals else (),
        best=best,
        rivals=tuple(rivals),
        ranking=ranking_of((*at_floor, *refused), best),
    )


def _unknown(candidates: Sequence[Candidate]) -> Verdict:
    return Verdict(
        kind=VerdictKind.UNKNOWN,
        effects=(),
        confusable=(),
        best=_nearest(candidates),
        ranking=ranking_of(candidates, None),
    )


def _alike(
    candidates: Sequence[Candidate], at_floor: Sequence[Candidate], best: Candidate, reached: float
) -> list[Candidate]:
    """Those at the floor that the best hardly leads, and a delay or a filter in place of the other."""
    alike = [
        c
        for c in at_floor
        if certain_lead(best, c, reached) <= SIMPLE_LEAD and says_something_else(best, c)
    ]
    late = [c for c in candidates if takes_for_a_filter(best, c) and may_be_it(best, c, reached)]
    return alike + [c for c in late if c not in alike]


def _refused(
    candidates: Sequence[Candidate], alike: Sequence[Candidate], best: Candidate, reached: float
) -> list[Candidate]:
    """Those that lead the best but do not explain the log, and those that it hardly leads."""
    leading = [
        c
        for c in candidates
        if c.score < reached and (says_something_else(best, c) or clearly_leads(c, reached))
    ]
    refused = [
        c for c in leading if c.refused_for_values or is_part(c, best) or is_richer_but_shifts(c, best)
    ]
    return refused + [c for c in candidates if c not in alike and hardly_led(c, best, reached)]


def _kind(best: Candidate, rivals: Sequence[Candidate], reached: float) -> VerdictKind:
    """Rivals leave it open, unless all of them are less likely than an effect that is named."""
    if rivals and not (best.named and all(less_likely(best, c, reached) for c in rivals)):
        return VerdictKind.UNDECIDED
    return VerdictKind.EXPLAINED if best.named else VerdictKind.NONE


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


def _nearest(candidates: Sequence[Candidate]) -> Candidate:
    """The likeliest; far above the noise, of those that leave hardly more, one of fewest parameters."""
    first = _first_of_equals(candidates)
    if first.fit.gap <= FAR_GAP:
        return first
    most = PLAINER_LEAVES * first.fit.gap
    plainer = [c for c in candidates if c.fit.gap <= most and c.fit.size < first.fit.size]
    other = {c.names: len({*c.names} - {*first.names}) for c in plainer}
    return min(plainer, key=lambda c: (c.fit.size, other[c.names], c.fit.gap), default=first)


def _first_of_equals(candidates: Sequence[Candidate]) -> Candidate:
    """The likeliest; of those that the log cannot tell from it, always the same one.

    Where a needle never slides, dry friction and that which depends on the speed are one.
    """
    equal = (c for c in candidates if c.score - candidates[0].score <= EQUAL_SCORE)
    return min(equal, key=lambda c: (len(c.names), sorted(c.names)))


def _simplest(at_floor: Sequence[Candidate]) -> Candidate:
    """Of the fewest effects among those within reach of the best; of the simplest form that does.

    Nothing is the answer only where it is the likeliest one. A part of the best is also within reach
    where no more leads it than laws of effects leave open.
    """
    best = at_floor[0]

    def reach(one: Candidate) -> float:
        return best.lead_over_part if {*one.names} < {*best.names} else SIMPLE_LEAD

    near = [c for c in at_floor if c.score - best.score <= reach(c) and (says(c) or c is best)]
    fewest = min(near, key=lambda c: (len(c.named), c.score))
    forms = (c for c in near if differ_in_one_form(fewest, c) and c.fit.size < fewest.fit.size)
    return next((c for c in forms if c.score - fewest.score <= NESTED_LEAD), fewest)

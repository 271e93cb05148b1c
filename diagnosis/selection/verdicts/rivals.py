"""What may be true in place of the best explanation: which candidates leave it open, or are only named.

Scores of candidates are compared; `reached` is that of the best.
"""

from diagnosis.criteria.selection import (
    LATE_LEAD,
    NEARLY,
    NESTED_LEAD,
    PART_LEAD,
    SHIFT_LIMIT,
)
from diagnosis.effects import FITTED, IMPERFECTIONS
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.scoring.complexity import complexity_penalty
from diagnosis.selection.verdicts.delay_or_filter import lags_little


def says_something_else(best: Candidate, other: Candidate) -> bool:
    """Whether another explanation says something else, and is not the best with more beside it.

    An effect may be taken for an imperfection of a sensor, so that these count here.
    """
    if not says(best):
        return False
    if set(best.named) == set(other.named):
        return False
    if differ_in_one_form(best, other):
        return best.fit.size < other.fit.size  # the other way round, NESTED_LEAD is enough
    return not _covers(other, best)


def is_part(one: Candidate, best: Candidate) -> bool:
    """Whether it is the best without some of its effects, and not at the noise floor."""
    return {*one.names} < {*best.names} and not one.floor.reached


def may_be_it(best: Candidate, late: Candidate, reached: float) -> bool:
    """Whether a delay in place of the filters of the best is led by what a replay may not resolve.

    That is no more than what the best itself leaves beyond noise. And where the best says nothing else,
    a delay at the floor may be the one cause that there is: then it is also what the noise of the
    encoder makes of the torque, which a filter takes away.

    Args:
      reached: score of the best.
    """
    behind, samples = late.score - reached, best.fit.samples
    beyond = max(sum(float(r @ r) for r in best.fit.by_trial) - samples, 0.0)
    alone = not best.named and late.floor.reached
    if not (late.explains or alone):
        return False
    return behind <= max(PART_LEAD, beyond + (late.base_noise_cost if alone else 0.0))


def certain_lead(best: Candidate, other: Candidate, reached: float) -> float:
    """The lead of the best over another, without what the unknown past of late trials may have made.

    What the other needs more has nothing to do with that, of effects or of stiffness and damping off.

    Args:
      reached: score of the best.
    """
    lead = other.score - reached
    if not best.begun_late:
        return lead
    of_size = complexity_penalty(other.fit) - complexity_penalty(best.fit)
    of_readings = lead - max(other.fit.prior - best.fit.prior, 0.0) - max(of_size, 0.0)
    return lead - min(max(of_readings, 0.0), LATE_LEAD)


def clearly_leads(one: Candidate, reached: float) -> bool:
    """Whether an explanation at a bound leads by more than what a replay may not resolve.

    Args:
      reached: score of the best.
    """
    return bool(one.reached_bounds) and one.refused_for_values and reached - one.score > PART_LEAD


def is_richer_but_shifts(one: Candidate, best: Candidate) -> bool:
    """Whether it is a richer form of the best that would explain the log, but for shifting trials."""
    richer = differ_in_one_form(best, one) and best.fit.size < one.fit.size
    return richer and one.floor.reached and one.shift > one.shift_limit


def hardly_led(one: Candidate, best: Candidate, reached: float) -> bool:
    """Whether it is a part of the best that is led by what a replay may not resolve.

    That is at the floor, or above it by a hair.

    Args:
      reached: score of the best.
    """
    part = {*one.names} < {*best.names} and one.floor.within(NEARLY)
    if not part or {*one.named} == {*best.named}:  # else only an imperfection of a sensor is doubtful
        return False
    lead, more = one.score - reached, len(best.names) - len(one.names)
    if one.explains and lead <= best.unresolved_cost:
        return True
    doubtful = one.shift > SHIFT_LIMIT or one.means_of > 1 or not one.floor.reached
    return says(one) != () and doubtful and lead <= more * PART_LEAD


def less_likely(best: Candidate, other: Candidate, reached: float) -> bool:
    """Whether less of a lead than SIMPLE_LEAD decides, so that the other is only named beside the best.

    It is a richer form of the best, which the data do not ask for; or behind by what stiffness and
    damping would have to be off for it, which is known and no noise; or a delay for a filter that does
    little.

    Args:
      reached: score of the best.
    """
    richer = differ_in_one_form(best, other) and best.fit.size < other.fit.size
    more_scatter = other.fit.prior - best.fit.prior > NESTED_LEAD and other.score > best.score
    behind = richer and other.score - reached > NESTED_LEAD
    return more_scatter or behind or lags_little(best, other)


def differ_in_one_form(one: Candidate, other: Candidate) -> bool:
    """Whether they differ in one effect, which is a special case of the other's."""
    mine, theirs = set(one.named) - set(other.named), set(other.named) - set(one.named)
    if len(mine) != 1 or len(theirs) != 1:
        return False
    a, b = mine.pop(), theirs.pop()
    return a in FITTED[b].contains or b in FITTED[a].contains


def _covers(other: Candidate, best: Candidate) -> bool:
    """Whether each effect of the best is there, or contained in one that is."""
    within = {name for o in says(other) for name in (o, *FITTED[o].contains)}
    return set(says(best)) <= within


def says(one: Candidate) -> tuple[str, ...]:
    """What is named, and imperfections of sensors."""
    return (*one.named, *(name for name in one.names if name in IMPERFECTIONS))

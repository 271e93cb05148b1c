"""What a stage of the search is, and what several of them share."""

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any

from diagnosis.criteria.selection import (
    FAULT_CONTENDERS,
    FAULT_PAIRS,
    FINALISTS,
    NEAR_FLOOR,
    NEARLY,
    SECOND_LEAVES,
    SIMPLE_LEAD,
    WORTH_THE_LOG,
)
from diagnosis.fitting.decimation import gap_on_the_log
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.fitting import Made, first_of, fit_all, fit_finalists
from diagnosis.selection.record import Decision, RecordEntry, dropped, failed, not_fitted
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.screening import Screened, screen
from diagnosis.selection.state import SearchState
from diagnosis.workers import Failure, Task, Workers

Stage = Callable[[SearchState, Workers], SearchState]


def run_stages(stages: Sequence[Stage], state: SearchState, workers: Workers) -> SearchState:
    """The state after those stages that there was time for; the nominal rig is in any."""
    for stage in stages:
        if workers.stop.due and state.candidates:
            workers.stop.leave_out(stage.__name__.replace("_", " "))
        else:
            state = stage(state, workers)
    return state


def first_that_explains(
    stages: Sequence[Stage], state: SearchState, workers: Workers
) -> SearchState | None:
    """The state after the first of some stages that explains the log; None: none does."""
    for stage in stages:
        after, explained = stage(state, workers).rechecked()
        if explained:
            return after
    return None


def screen_all(
    stage: str, calls: Sequence[tuple[FitProblem, Fit, str]], workers: Workers
) -> tuple[list[Screened], tuple[RecordEntry, ...]]:
    """Calls of `screen` (problem, fit, name): all starts of all effects, and the record."""
    tasks = [
        Task(effects=(*base.names, name), arguments=(problem, base, name))
        for problem, base, name in calls
    ]
    results = workers.each(f"screening {stage}", screen, tasks)
    found = [s for own in results if not isinstance(own, Failure) for s in own]
    return found, failed(stage, [r for r in results if isinstance(r, Failure)])


def promising_on_the_log(
    stage: str, screened: Sequence[Screened], without: float, state: SearchState, workers: Workers
) -> list[Screened]:
    """Of sets that add an effect to what explains the log, those that promise enough on the log itself.

    The decimated log is replayed coarsely: of rough friction that leaves what any effect could take.

    Args:
      without: cost without the added effect, on the decimated log.
    """
    known = {c.names: c.fit for c in state.candidates}
    calls = [
        (state.problem, known[names], name)
        for names, name in dict.fromkeys((s.names[:-1], s.names[-1]) for s in screened)
        if names in known
    ]
    found, _ = screen_all(stage, calls, workers)
    asked = (1 - SECOND_LEAVES) * without
    enough = {s.names for s in found if known[s.names[:-1]].cost - s.cost > asked}
    return [s for s in screened if s.names in enough or s.names[:-1] not in known]


def taking_off_enough(stage: str, made: Made, without: float, state: SearchState) -> Made:
    """Sets that take off the log itself what their last effect has to promise on the decimated one.

    Args:
      without: cost without that effect, on the decimated log.
    """
    found, record = made
    most = min(c.fit.cost for c in state.candidates) - (1 - SECOND_LEAVES) * without
    enough = [c for c in found if c.fit.cost <= most]
    out = [c for c in found if c not in enough]
    reason = f"its last effect leaves more than {SECOND_LEAVES:g} of the cost without it"
    return enough, (*record, *dropped(stage, out, reason))


def alike_on_the_decimated_log(found: Sequence[Candidate]) -> list[Candidate]:
    """The first of the decimated log and those about as likely there, of which any may be a part."""
    ranked = sorted(found, key=lambda c: c.score)
    return first_of([c for c in ranked if c.score - ranked[0].score <= SIMPLE_LEAD], FINALISTS)


def near_the_best(found: Sequence[Candidate], best: Sequence[Candidate], most: int) -> list[Candidate]:
    """The leading candidates of the decimated log, but for those that leave far more than the best.

    Args:
      best: what is compared with, besides them.
      most: number of them at most.
    """
    least = min((c.fit.cost for c in (*found, *best)), default=math.inf)
    ranked = sorted(found, key=lambda c: c.score)
    return [c for c in ranked if c.fit.cost <= NEAR_FLOOR * least][:most]


def worth_the_log(
    stage: str, fitted: Sequence[Candidate], before: Sequence[Candidate]
) -> tuple[list[Candidate], tuple[RecordEntry, ...]]:
    """Of sets on the decimated log, those that leave clearly less beyond noise than the best before."""
    worth = leaving_clearly_less(fitted, before)
    out = [c for c in fitted if c not in worth]
    return worth, dropped(stage, out, "it leaves hardly less beyond noise than fewer or simpler effects")


def leaving_clearly_less(fitted: Sequence[Candidate], before: Sequence[Candidate]) -> list[Candidate]:
    """Sets on the decimated log that take off some of what the best before leaves beyond noise."""
    least = min((c.fit.cost for c in before), default=math.inf)
    samples = before[0].fit.samples if before else 0
    return [c for c in fitted if least - c.fit.cost >= WORTH_THE_LOG * (least - samples)]


def leading_sets(found: Sequence[Candidate]) -> list[Candidate]:
    """The leading sets on the decimated log, each once."""
    ranked = sorted(found, key=lambda c: c.score)
    distinct = {frozenset(c.names): c for c in reversed(ranked)}
    return first_of(sorted(distinct.values(), key=lambda c: c.score), FAULT_CONTENDERS // 2)


def leading_on_the_log(state: SearchState) -> list[Candidate]:
    """The leading explanations on the log itself, best first."""
    return first_of(sorted(state.candidates, key=lambda c: c.score), FINALISTS)


def leading_fitted_again(stage: str, state: SearchState, problem: FitProblem, workers: Workers) -> Made:
    """The leading explanations on the log itself, fitted to another problem from where they are.

    With their best parts among them, and the nominal rig: effects that lead by what the other problem
    explains are not there.
    """
    found = [*leading_on_the_log(state), *_parts_of_the_leading(state)]
    leading = {frozenset(c.names): c for c in reversed(found)}
    calls = [
        (problem, c.names, problem.parameterization(c.names).joined(c.fit.parts))
        for c in leading.values()
    ]
    return fit_all(stage, calls, workers)


def near_fitted_again(
    stage: str, state: SearchState, begun: SearchState, workers: Workers, most_gap: float = NEARLY
) -> SearchState:
    """The leading explanations of a state that come near the noise in another on the decimated log.

    Args:
      begun: the other, of which more is open, and to which nothing has been fitted.
      most_gap: gap on the log up to which an explanation is near.
    """
    rare, record = leading_fitted_again(stage, state, begun.coarse, workers)
    near = [c for c in rare if gap_on_the_log(c.fit.gap, begun.problem, begun.coarse) <= most_gap]
    begun, problem = begun.noting(*record), begun.problem
    calls = [(problem, c.names, problem.parameterization(c.names).joined(c.fit.parts)) for c in near]
    return begun.adding(fit_all(stage, calls, workers)) if calls else begun


def _parts_of_the_leading(state: SearchState) -> list[Candidate]:
    """The best others with some of the effects of leading ones, and the best with none."""
    leading = [frozenset(c.names) for c in leading_on_the_log(state)]
    ranked = sorted(state.candidates, key=lambda c: c.score)
    others = [c for c in ranked if c.names and frozenset(c.names) not in leading]
    parts = [c for c in others if any({*c.names} < names for names in leading)]
    return parts[: FINALISTS // 2] + [c for c in ranked if not c.names][:1]


def fitted_again(
    stage: str,
    start: SearchState,
    calls: Sequence[tuple[Any, ...]],
    workers: Workers,
    screened: Sequence[Screened] = (),
) -> SearchState:
    """The state of a log of which more is allowed for, with the contenders of the one before, both on
    the log itself and decimated.

    Args:
      calls: of `fit_in_turn`, on the decimated log.
      screened: pairs there, of which the most promising are fitted as well.
    """
    coarse, record = fit_all(stage, calls, workers)
    new, more = fit_screened(stage, start.coarse, screened, FAULT_PAIRS, workers)
    known = {frozenset(c.names) for c in coarse}
    coarse, record = [*coarse, *(c for c in new if frozenset(c.names) not in known)], (*record, *more)
    begun = start.adding(([candidate(start.nominal)], record))
    begun = begun.adding(fit_all(stage, [(start.problem, ())], workers))
    if not coarse:
        return begun
    singles, pairs = (tuple(c for c in coarse if len(c.names) == size) for size in (1, 2))
    begun = replace(begun, singles=singles, pairs=pairs)
    return begun.adding(fit_finalists(stage, start.problem, simplest_first(coarse), workers))


def simplest_first(found: Sequence[Candidate]) -> list[Candidate]:
    """Best first, those last that are behind a part of their own: they would crowd out what is rival."""

    def behind_a_part(one: Candidate) -> bool:
        return any({*c.names} < {*one.names} and c.score <= one.score for c in found)

    return sorted(found, key=lambda c: (behind_a_part(c), c.score))


def not_worth(
    stage: str, screened: Sequence[Screened], worth: Sequence[Screened]
) -> tuple[RecordEntry, ...]:
    """The record of what was screened and is not worth a fit."""
    fitted = {s.names for s in worth}
    out = dict.fromkeys(s.names for s in screened if s.names not in fitted)
    return not_fitted(stage, out, "screening promises too little")


def stopped_in(record: Sequence[RecordEntry]) -> list[RecordEntry]:
    """What a stop has cut short."""
    return [entry for entry in record if entry.decision is Decision.STOPPED]

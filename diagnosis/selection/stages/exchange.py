"""Another effect in place of one of several that explain the log, or nearly do.

The search builds sets up, so that an effect which leads alone stays in them. Where nothing explains the
log, and it only imitates the true one, the others are right: the leading set is fitted without each of
its effects in turn, and every other one is screened in its place.

Where a set explains the log, one with another effect in place of one of its own may do so as well, or
better, but its fits may have ended elsewhere: it begins once more from where the others are.
"""

from collections.abc import Sequence
from typing import Any

from diagnosis.criteria.selection import EXCHANGE_GAP, FITS_AT_ONCE, MOST_EXCHANGED, NEAR_FLOOR
from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import Fit, fit_left_at
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.record import dropped
from diagnosis.selection.richer_forms import overlap
from diagnosis.selection.scoring.unresolved import contending
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages import pairs, triples
from diagnosis.selection.stages.stage import not_worth, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Failure, Task, Workers

STAGE, IN_THE_BEST = "exchanges", "exchanges in the best"
_BUILDING_UP = (pairs.STAGE, triples.STAGE)
"""Stages that screen every effect beside a set."""


def exchanges(state: SearchState, workers: Workers) -> SearchState:
    """The state with leading sets of which one effect is exchanged for another."""
    state, explained = state.rechecked()
    leading = state.best
    if explained or len(_effects(leading)) < 2 or leading.fit.gap > EXCHANGE_GAP:
        return state
    fewer = _not_yet_asked(leading, state)
    if not fewer:
        return state
    fitted, record = fit_all(STAGE, _calls([leading.names, *fewer], leading, state), workers)
    known = {c.names: c for c in fitted}
    state = state.noting(*record)
    if leading.names not in known:
        return state
    without = [known[names] for names in fewer if names in known]
    ahead, state = _exchanged(leading, known[leading.names], without, state, workers)
    if not ahead:
        return state
    return state.adding(fit_finalists(f"finalists, {STAGE}", state.problem, ahead, workers))


def exchanges_in_the_best(state: SearchState, workers: Workers) -> SearchState:
    """The state with sets that may explain the log as the best does, but for one of its effects."""
    state, explained = state.rechecked()
    best, coarse = state.best, state.coarse
    if not explained or len(_effects(best)) < 2 or not state.at_the_floor(best):
        return state
    fewer = [tuple(name for name in best.names if name != effect) for effect in _effects(best)]
    whole, *without = workers.each(
        IN_THE_BEST, fit_left_at, [_as_in(best, names, coarse) for names in (best.names, *fewer)]
    )
    if isinstance(whole, Failure):
        return state
    left = [fit for fit in without if not isinstance(fit, Failure)]
    screened, record = screen_all(IN_THE_BEST, _others(best, left, state), workers)
    known = {frozenset(c.names) for c in state.candidates}
    worth = [s for s in screened if s.cost < NEAR_FLOOR * whole.cost and frozenset(s.names) not in known]
    found, made = fit_screened(IN_THE_BEST, coarse, worth, FITS_AT_ONCE, workers)
    near = [c for c in found if c.score < candidate(whole).score + contending(coarse)]
    state = state.noting(*record, *not_worth(IN_THE_BEST, screened, worth), *made)
    return state.adding(fit_finalists(f"finalists, {IN_THE_BEST}", state.problem, near, workers))


def _as_in(best: Candidate, names: tuple[str, ...], problem: FitProblem) -> Task:
    """A call of `fit_left_at`: a set of effects with the values of another one."""
    x = problem.parameterization(names).joined(best.fit.parts)
    return Task(effects=names, arguments=(problem, names, x))


def _exchanged(
    leading: Candidate,
    rare: Candidate,
    without: Sequence[Candidate],
    state: SearchState,
    workers: Workers,
) -> tuple[list[Candidate], SearchState]:
    """Sets of the decimated log that are ahead of the leading one there, and the state.

    Args:
      rare: the leading set on the decimated log.
      without: smaller sets there, beside which every other effect is screened.
    """
    fits = [one.fit for one in without]
    screened, record = screen_all(STAGE, _others(leading, fits, state), workers)
    worth = [s for s in screened if s.cost < rare.fit.cost]
    found, made = fit_screened(STAGE, state.coarse, worth, MOST_EXCHANGED, workers)
    ahead = [c for c in found if c.score < rare.score]
    behind = dropped(STAGE, [c for c in found if c not in ahead], "the leading set fits better")
    return ahead, state.noting(*record, *not_worth(STAGE, screened, worth), *made, *behind)


def _effects(one: Candidate) -> list[str]:
    """Effects of a candidate, without imperfections of sensors."""
    return [name for name in one.names if name in LIBRARY]


def _not_yet_asked(leading: Candidate, state: SearchState) -> list[tuple[str, ...]]:
    """The leading set without each effect, but for sets beside which all others were screened."""
    asked = {frozenset(entry.effects[:-1]) for entry in state.record if entry.stage in _BUILDING_UP}
    fewer = [tuple(name for name in leading.names if name != effect) for effect in _effects(leading)]
    return [names for names in fewer if frozenset(names) not in asked]


def _calls(
    sets: Sequence[tuple[str, ...]], leading: Candidate, state: SearchState
) -> list[tuple[Any, ...]]:
    """Fits of sets to the decimated log, from where the leading one is."""
    coarse = state.coarse
    return [(coarse, names, coarse.parameterization(names).joined(leading.fit.parts)) for names in sets]


def _others(leading: Candidate, without: Sequence[Fit], state: SearchState) -> list[tuple[Any, ...]]:
    """Calls of `screen`: each of the smaller sets with every effect that is not in the leading one."""
    return [
        (state.coarse, one, name)
        for one in without
        for name in state.effects
        if name not in leading.names and not overlap(name, one.names)
    ]

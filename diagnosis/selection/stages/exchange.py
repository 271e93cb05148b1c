"""Where nothing explains the log, but several effects nearly do: another one in place of one of them.

The search builds sets up, so that an effect which leads alone stays in them. Where it only imitates the
true one, the others are right: the leading set is fitted without each of its effects in turn, and every
other one is screened in its place.
"""

from collections.abc import Sequence
from typing import Any

from diagnosis.criteria.selection import EXCHANGE_GAP, MOST_EXCHANGED
from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.record import dropped
from diagnosis.selection.richer_forms import overlap
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages import pairs, triples
from diagnosis.selection.stages.stage import not_worth, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "exchanges"
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
    screened, record = screen_all(STAGE, _others(leading, without, state), workers)
    worth = [s for s in screened if s.cost < rare.fit.cost]
    found, fits = fit_screened(STAGE, state.coarse, worth, MOST_EXCHANGED, workers)
    ahead = [c for c in found if c.score < rare.score]
    behind = dropped(STAGE, [c for c in found if c not in ahead], "the leading set fits better")
    return ahead, state.noting(*record, *not_worth(STAGE, screened, worth), *fits, *behind)


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


def _others(
    leading: Candidate, without: Sequence[Candidate], state: SearchState
) -> list[tuple[Any, ...]]:
    """Calls of `screen`: each of the smaller sets with every effect that is not in the leading one."""
    return [
        (state.coarse, one.fit, name)
        for one in without
        for name in state.effects
        if name not in leading.names and not overlap(name, one.names)
    ]

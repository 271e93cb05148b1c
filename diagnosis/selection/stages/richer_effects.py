"""Effects that contain a simpler one, fitted from where that is; and the other way round."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.selection import CONTENDING, FINALISTS, SIMPLE_LEAD
from diagnosis.effects import FITTED
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.richer_forms import forms_beyond, with_richer
from diagnosis.selection.scoring.unresolved import contending
from diagnosis.selection.stages.stage import worth_the_log
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]

STAGE, SIMPLER = "richer effects", "simpler effects"
_STARTS = 2  # forms from which fits start


def richer_effects(state: SearchState, workers: Workers) -> SearchState:
    """Where nothing explains the log: effects that contain one of a leading set, from where that is.

    Fitted from far off they may have ended in a local minimum, above what they contain.
    """
    leading = sorted((*state.singles, *state.pairs), key=lambda c: c.score)[:FINALISTS]
    if not any(_richer(c, state) for c in leading):
        return state
    state, explained = state.rechecked()
    if explained:
        return state
    ahead, state = _ahead(leading, state, workers)
    worth, behind = worth_the_log(STAGE, ahead, leading[:1])
    return _on_the_log(worth, state.noting(*behind), workers)


def richer_effects_in_place_of_three(state: SearchState, workers: Workers) -> SearchState:
    """The same of three effects, also where they explain the log: no pair of theirs asked for more."""
    leading = sorted(state.triples, key=lambda c: c.score)[:1]
    return _on_the_log(*_ahead(leading, state, workers), workers)


def richer_effects_in_the_best(state: SearchState, workers: Workers) -> SearchState:
    """The same in the best that explains the log, on the log itself.

    A richer law leaves no more than the simpler one. Where its fit did, or hardly less, it may have
    ended in the corner in which it is the simpler one. Alone it was fitted from many starts.
    """
    best = state.best
    state, _ = state.rechecked()
    if len(best.names) < 2 or not state.at_the_floor(best):
        return state
    known = {frozenset(c.names): c.fit.cost for c in sorted(state.candidates, key=lambda c: -c.fit.cost)}
    calls = [
        (state.problem, names, start, best.score + CONTENDING)
        for simple, rich in _containing(best, state)
        for names in [with_richer(best, simple, rich)]
        if known.get(frozenset(names), -np.inf) > best.fit.cost - SIMPLE_LEAD
        for start in forms_beyond(state.problem, best, simple, rich)[:_STARTS]
    ]
    return state.adding(fit_all(f"{STAGE} in the best", calls, workers))


def simpler_effects(state: SearchState, workers: Workers) -> SearchState:
    """What an effect of the best contains, in its place, where that never came to the log itself.

    On the decimated log a richer law may imitate what this is too coarse for, and leave the simpler one
    behind.
    """
    best = state.best
    state, _ = state.rechecked()
    inner = [(rich, simple) for rich in best.names for simple in FITTED[rich].contains]
    if not inner or not state.at_the_floor(best):
        return state
    known = {frozenset(c.names) for c in state.candidates}
    simpler = {
        names: simple
        for rich, simple in inner
        if simple not in best.names
        for names in [tuple(simple if name == rich else name for name in best.names)]
        if frozenset(names) not in known
    }
    enough = best.score + contending(state.problem)
    calls = [
        (state.problem, names, _with_simple(state, best, names, simple), enough)
        for names, simple in simpler.items()
    ]
    return state.adding(fit_all(SIMPLER, calls, workers))


def _with_simple(state: SearchState, best: Candidate, names: tuple[str, ...], simple: str) -> Array:
    """Where a set with a simpler effect begins: as the best, and with that as the decimated log has it.

    From where it is absent, stick and slip show no way to it.
    """
    decimated = [c for c in (*state.triples, *state.pairs, *state.singles) if simple in c.names]
    alike = sorted(decimated, key=lambda c: len({*names} ^ {*c.names}))
    own = {simple: alike[0].fit.parts[simple]} if alike else {}
    return state.problem.parameterization(names).joined(best.fit.parts | own)


def _ahead(
    leading: Sequence[Candidate], state: SearchState, workers: Workers
) -> tuple[list[Candidate], SearchState]:
    """The best richer set of the decimated log, if it is ahead of all that lead, and the state."""
    inner = next((c for c in leading if _richer(c, state)), None)
    if inner is None:
        return [], state
    enough = leading[0].score + CONTENDING
    calls = [
        (state.coarse, names, start, enough)
        for simple, rich in _richer(inner, state)
        for names in [with_richer(inner, simple, rich)]
        for start in forms_beyond(state.coarse, inner, simple, rich)[:_STARTS]
    ]
    fitted, record = fit_all(STAGE, calls, workers)
    ahead = sorted((c for c in fitted if c.score < leading[0].score), key=lambda c: c.score)
    return ahead[:1], state.noting(*record)


def _on_the_log(ahead: Sequence[Candidate], state: SearchState, workers: Workers) -> SearchState:
    if not ahead:
        return state
    made = fit_finalists(f"finalists, {STAGE}", state.problem, ahead, workers)
    return replace(state, pairs=(*state.pairs, *ahead)).adding(made)


def _richer(one: Candidate, state: SearchState) -> list[tuple[str, str]]:
    """Effects of a candidate, each with one that contains it and was not yet well fitted in its place.

    A fit that stalled may be far from its minimum: where friction sticks and slips a cost is rough.
    """
    done = {
        frozenset(c.names)
        for c in (*state.singles, *state.pairs, *state.triples)
        if c.fit.cost <= one.fit.cost and c.fit.status.converged
    }
    done |= {frozenset(entry.effects) for entry in state.record if entry.stage == STAGE}
    return [
        (inner, rich)
        for inner, rich in _containing(one, state)
        if frozenset(with_richer(one, inner, rich)) not in done
    ]


def _containing(one: Candidate, state: SearchState) -> list[tuple[str, str]]:
    """Effects of a candidate, each with one that contains it and is not there itself."""
    return [
        (inner, rich)
        for inner in one.names
        for rich in state.effects
        if inner in FITTED[rich].contains and rich not in one.names
    ]

"""Effects that contain a simpler one, fitted from where that is."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import CONTENDING, FINALISTS
from diagnosis.effects import FITTED
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]


def richer_effects(state: SearchState, workers: Workers) -> SearchState:
    """Where nothing explains the log: effects that contain one of a leading set, from where that is.

    Fitted from far off they may have ended in a local minimum, above what they contain.
    """
    leading = sorted((*state.singles, *state.pairs), key=lambda c: c.score)[:FINALISTS]
    if not any(_richer(c, state.effects) for c in leading) or state.rechecked()[1]:
        return state
    return _with_richer(leading, state, workers)


def richer_effects_in_place_of_three(state: SearchState, workers: Workers) -> SearchState:
    """The same of three effects, also where they explain the log: no pair of theirs asked for more."""
    leading = sorted(state.triples, key=lambda c: c.score)[:1]
    return _with_richer(leading, state, workers)


def _with_richer(leading: Sequence[Candidate], state: SearchState, workers: Workers) -> SearchState:
    stage = "richer effects"
    inner = next((c for c in leading if _richer(c, state.effects)), None)
    if inner is None:
        return state
    enough = leading[0].score + CONTENDING
    calls = [
        (state.coarse, names, start, enough)
        for simple, rich in _richer(inner, state.effects)
        for names, start in _starts_beyond(state.coarse, inner, simple, rich)
    ]
    fitted, record = fit_all(stage, calls, workers)
    ahead = sorted((c for c in fitted if c.score < leading[0].score), key=lambda c: c.score)
    state = replace(state.noting(*record), pairs=(*state.pairs, *ahead[:1]))
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, ahead[:1], workers))


def _richer(one: Candidate, effects: Sequence[str]) -> list[tuple[str, str]]:
    """Effects of a candidate, each with one that contains it and is not there."""
    others = [name for name in effects if name not in one.names]
    return [(inner, rich) for inner in one.names for rich in others if inner in FITTED[rich].contains]


def _starts_beyond(
    problem: FitProblem, one: Candidate, simple: str, rich: str
) -> list[tuple[tuple[str, ...], Array]]:
    """The candidate's set with a richer effect in place of a simple one, and where its fit may start."""
    names = tuple(rich if name == simple else name for name in one.names)
    values = [
        p.from_fit(float(v))
        for p, v in zip(problem.library[simple].parameters, one.fit.parts[simple], strict=True)
    ]
    effect, parameterization = problem.library[rich], problem.parameterization(names)
    found = []
    for start in effect.contains[simple](*values):
        own = np.array([p.to_fit(v) for p, v in zip(effect.parameters, start, strict=True)])
        found.append((names, parameterization.joined({**one.fit.parts, rich: own})))
    return found

"""Where nothing explains the log, but several effects nearly do: another one in place of one of them.

The search builds sets up, so that an effect which leads alone stays in them. Where it only imitates the
true one, the others are right: the leading set is fitted without each of its effects in turn, and every
other one is screened in its place.
"""

from collections.abc import Sequence
from typing import Any

from diagnosis.criteria import EXCHANGE_GAP, MOST_EXCHANGED
from diagnosis.effects import LIBRARY
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.record import dropped
from diagnosis.selection.richer_forms import overlap
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages.stage import not_worth, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "exchanges"


def one_effect_exchanged(state: SearchState, workers: Workers) -> SearchState:
    """The state with leading sets of which one effect is exchanged for another."""
    state, explained = state.rechecked()
    leading = state.best
    if explained or len(_effects(leading)) < 2 or leading.fit.gap > EXCHANGE_GAP:
        return state
    fitted, record = fit_all(STAGE, _calls(leading, state), workers)
    on_the_decimated_log = [c for c in fitted if {*c.names} == {*leading.names}]
    without = [c for c in fitted if c not in on_the_decimated_log]
    state = state.noting(*record)
    if not on_the_decimated_log:
        return state
    reference = on_the_decimated_log[0]
    screened, record = screen_all(STAGE, _others(leading, without, state), workers)
    worth = [s for s in screened if s.cost < reference.fit.cost]
    better, more = fit_screened(STAGE, state.coarse, worth, MOST_EXCHANGED, workers)
    ahead = [c for c in better if c.score < reference.score]
    behind = dropped(STAGE, [c for c in better if c not in ahead], "the leading set fits better")
    state = state.noting(*record, *not_worth(STAGE, screened, worth), *more, *behind)
    if not ahead:
        return state
    return state.adding(fit_finalists(f"finalists, {STAGE}", state.problem, ahead, workers))


def _effects(one: Candidate) -> list[str]:
    """Effects of a candidate, without imperfections of sensors."""
    return [name for name in one.names if name in LIBRARY]


def _calls(leading: Candidate, state: SearchState) -> list[tuple[Any, ...]]:
    """Fits on the decimated log, from where the leading set is: of itself, and without each effect.

    Sets beside which every other effect was tried already are left out.
    """
    asked = {frozenset(entry.effects[:-1]) for entry in state.record if entry.effects}
    fewer = [
        names
        for effect in _effects(leading)
        for names in [tuple(name for name in leading.names if name != effect)]
        if frozenset(names) not in asked
    ]
    sets = [leading.names, *fewer] if fewer else []
    return [
        (state.coarse, names, state.coarse.parameterization(names).joined(leading.fit.parts))
        for names in sets
    ]


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

"""Pairs of effects: a leading one with any other."""

from dataclasses import replace
from itertools import product

from diagnosis.criteria.selection import MOST_PAIRS, PAIR_BASES, SECOND_LEAVES, WORTH_FITTING
from diagnosis.selection.fitting import fit_finalists
from diagnosis.selection.richer_forms import overlap
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages.stage import (
    alike_on_the_decimated_log,
    not_worth,
    promising_on_the_log,
    screen_all,
    taking_off_enough,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "pairs"


def pairs(state: SearchState, workers: Workers) -> SearchState:
    """Pairs, where no effect alone explains the log, or where a second promises enough."""
    state, alone = state.rechecked()
    leading = alike_on_the_decimated_log(state.singles) if alone else state.singles[:PAIR_BASES]
    calls = [
        (state.coarse, base.fit, effect)
        for base, effect in product(leading, state.effects)
        if not overlap(effect, base.names)
    ]
    screened, record = screen_all(STAGE, calls, workers)
    state = state.noting(*record)
    worth = [s for s in screened if _worth_a_second(s, state, alone=alone)]
    if worth and alone:
        worth = promising_on_the_log(STAGE, worth, state.singles[0].fit.cost, state, workers)
    fitted, record = fit_screened(STAGE, state.coarse, worth, MOST_PAIRS, workers)
    state = state.noting(*not_worth(STAGE, screened, worth), *record)
    state = replace(state, pairs=tuple(fitted))
    made = fit_finalists("finalists, pairs", state.problem, fitted, workers)
    if alone and state.singles:
        made = taking_off_enough("finalists, pairs", made, state.singles[0].fit.cost, state)
    return state.adding(made)


def _worth_a_second(one: Screened, state: SearchState, *, alone: bool) -> bool:
    if not alone:
        return one.gain >= WORTH_FITTING
    return one.cost < SECOND_LEAVES * state.singles[0].fit.cost

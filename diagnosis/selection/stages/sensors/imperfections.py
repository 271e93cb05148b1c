"""Two imperfections of sensors beside one effect, or two effects.

Three that act at once are looked for on the decimated log. Where they nearly explain a log, of which two
are effects, a second imperfection is looked for beside them on the log itself: it changes little.
"""

from itertools import product

from diagnosis.criteria.selection import (
    EXCHANGE_GAP,
    FINALISTS,
    IMPERFECT_BASES,
    MOST_PAIRS,
    WORTH_FITTING,
)
from diagnosis.effects import FITTED, IMPERFECTIONS
from diagnosis.selection.fitting import fit_all, fit_finalists
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages.stage import near_the_best, not_worth, screen_all, worth_the_log
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

_AT_ONCE = 3  # effects and imperfections that the decimated log is searched for


def imperfections_of_sensors(state: SearchState, workers: Workers) -> SearchState:
    """Where nothing explains the log: one effect at most, with two imperfections of sensors."""
    stage = "imperfections of sensors"
    state, explained = state.rechecked()
    if explained:
        return state
    rough = [c for c in state.pairs if any(name in IMPERFECTIONS for name in c.names)]
    more = [name for name in state.effects if name in IMPERFECTIONS]
    leading = near_the_best(rough, (*state.singles, *state.pairs), IMPERFECT_BASES)
    bases = product(leading, more)
    calls = [(state.coarse, base.fit, name) for base, name in bases if name not in base.names]
    screened, record = screen_all(stage, calls, workers)
    worth = [s for s in screened if s.gain >= WORTH_FITTING]
    fitted, fits = fit_screened(stage, state.coarse, worth, MOST_PAIRS, workers)
    fitted, behind = worth_the_log(stage, fitted, (*state.singles, *state.pairs))
    state = state.noting(*record, *not_worth(stage, screened, worth), *fits, *behind)
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, fitted, workers))


def imperfections_beside_three(state: SearchState, workers: Workers) -> SearchState:
    """Where three effects and imperfections nearly explain the log: a further imperfection, or delay."""
    state, explained = state.rechecked()
    if explained or len(state.best.names) < _AT_ONCE:
        return state
    return imperfections_beside_the_best("imperfections beside three", state, workers)


def imperfections_beside_the_best(stage: str, state: SearchState, workers: Workers) -> SearchState:
    """Where the best nearly explains the log: a further imperfection, or delay, beside it."""
    best = state.best
    if best.fit.gap > EXCHANGE_GAP:
        return state
    more = [n for n in state.effects if n in IMPERFECTIONS or FITTED[n].delays_a_sensor]
    calls = [(state.problem, best.fit, name) for name in more if name not in best.names]
    screened, record = screen_all(stage, calls, workers)
    worth = sorted((s for s in screened if s.gain >= WORTH_FITTING), key=lambda s: s.cost)
    first = {s.names: s for s in reversed(worth)}
    leading = sorted(first.values(), key=lambda s: s.cost)[: FINALISTS // 2]
    state = state.noting(*record, *not_worth(stage, screened, leading))
    return state.adding(fit_all(stage, [(state.problem, s.names, s.start) for s in leading], workers))

"""Two imperfections of sensors beside one effect at most."""

from itertools import product

from diagnosis.criteria import IMPERFECT_BASES, MOST_PAIRS, WORTH_FITTING
from diagnosis.effects import IMPERFECTIONS
from diagnosis.selection.fitting import fit_finalists
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.stages.stage import near_the_best, not_worth, screen_all, worth_the_log
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def one_more_imperfection(state: SearchState, workers: Workers) -> SearchState:
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

"""Three effects at once: a leading pair with any other, where no pair explains the log."""

from diagnosis.criteria import MOST_TRIPLES, TRIPLE_BASES, WORTH_FITTING
from diagnosis.selection.fitting import fit_finalists, fit_screened
from diagnosis.selection.stages.stage import not_worth, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def triples(state: SearchState, workers: Workers) -> SearchState:
    """Every effect beside each of the leading pairs; the promising are fitted."""
    stage = "three effects"
    state, explained = state.rechecked()
    if explained or not state.pairs:
        return state
    leading = sorted(state.pairs, key=lambda c: c.score)[:TRIPLE_BASES]
    calls = [
        (state.coarse, base.fit, name)
        for base in leading
        for name in state.effects
        if name not in base.names
    ]
    screened, record = screen_all(stage, calls, workers)
    worth = [s for s in screened if s.gain >= WORTH_FITTING]
    fitted, fits = fit_screened(stage, state.coarse, worth, MOST_TRIPLES, workers)
    state = state.noting(*record, *not_worth(stage, screened, worth), *fits)
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, fitted, workers))

"""Three effects at once: a leading pair with any other, where no pair explains the log.

Three laws can imitate much. So the third has to promise most of what the pair leaves beyond noise.
"""

from diagnosis.criteria import MOST_TRIPLES, TRIPLE_BASES, TRIPLE_SHARE, WORTH_FITTING
from diagnosis.fitting.fit import Fit
from diagnosis.selection.fitting import fit_finalists, fit_screened
from diagnosis.selection.screening import Screened
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
    pairs = {pair.names: pair.fit for pair in leading}
    calls = [
        (state.coarse, pair, name)
        for names, pair in pairs.items()
        for name in state.effects
        if name not in names
    ]
    screened, record = screen_all(stage, calls, workers)
    worth = [s for s in screened if _worth_a_third(s, pairs[s.names[:-1]])]
    fitted, fits = fit_screened(stage, state.coarse, worth, MOST_TRIPLES, workers)
    state = state.noting(*record, *not_worth(stage, screened, worth), *fits)
    if not fitted:
        return state
    return state.adding(fit_finalists(f"finalists, {stage}", state.problem, fitted, workers))


def _worth_a_third(one: Screened, pair: Fit) -> bool:
    """Whether the third effect promises enough, of itself and of what the pair leaves."""
    beyond_noise = pair.cost - pair.samples
    return one.gain >= WORTH_FITTING and pair.cost - one.cost >= TRIPLE_SHARE * beyond_noise

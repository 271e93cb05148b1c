"""Three effects at once: a leading pair with any other.

Where none of the leading pairs has a third that promises enough, the next pairs are asked: two effects
that imitate three may lead. Three laws can imitate much. So the third has to promise most of what the
pair leaves beyond noise, where that does not explain the log; and where it does, more than noise could.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from diagnosis.criteria.selection import (
    MOST_TRIPLES,
    SECOND_LEAVES,
    TRIPLE_BASES,
    TRIPLE_OTHERS,
    TRIPLE_SHARE,
    WORTH_FITTING,
)
from diagnosis.fitting.fit import Fit
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_finalists
from diagnosis.selection.record import RecordEntry, dropped
from diagnosis.selection.richer_forms import overlap
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages.stage import (
    alike_on_the_decimated_log,
    leaving_clearly_less,
    near_the_best,
    not_worth,
    promising_on_the_log,
    screen_all,
    taking_off_enough,
    worth_the_log,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "three effects"

_Pairs = Mapping[tuple[str, ...], Fit]


def three_effects(state: SearchState, workers: Workers) -> SearchState:
    """Every effect beside the leading pairs, or beside the one that explains the log."""
    state, explained = state.rechecked()
    pairs = _explaining(state) if explained else _leading(state)
    screened, worth, record = _screened(state, pairs, workers, explained=explained)
    if not (worth or explained):
        pairs = _others(state, pairs)
        more, worth, entries = _screened(state, pairs, workers, explained=False)
        screened, record = [*screened, *more], (*record, *entries)
    if worth and explained:
        worth = promising_on_the_log(STAGE, worth, _least(pairs), state, workers)
    fitted, fits = fit_screened(STAGE, state.coarse, worth, MOST_TRIPLES, workers)
    needless = [c for c in fitted if c.as_good_as_none]
    fitted = [c for c in fitted if c not in needless]
    fits = (*fits, *dropped(STAGE, needless, "one of its effects is as good as none"))
    if not explained:
        fitted, behind = worth_the_log(STAGE, fitted, state.pairs)
        fits = (*fits, *behind)
    state = state.noting(*record, *not_worth(STAGE, screened, worth), *fits)
    if not fitted:
        return state
    state = replace(state, triples=tuple(fitted))
    made = fit_finalists(f"finalists, {STAGE}", state.problem, fitted, workers)
    if explained:
        made = taking_off_enough(f"finalists, {STAGE}", made, _least(pairs), state)
    return state.adding(made)


def _screened(
    state: SearchState, pairs: _Pairs, workers: Workers, *, explained: bool
) -> tuple[list[Screened], list[Screened], tuple[RecordEntry, ...]]:
    """Pairs with every other effect, those of them that are worth a fit, and the record."""
    calls = [
        (state.coarse, pair, name)
        for names, pair in pairs.items()
        for name in state.effects
        if not overlap(name, names)
    ]
    found, record = screen_all(STAGE, calls, workers)
    worth = [s for s in found if _worth_a_third(s, pairs[s.names[:-1]], explained=explained)]
    return found, worth, record


def _least(pairs: _Pairs) -> float:
    """Least cost of pairs on the decimated log."""
    return min(pair.cost for pair in pairs.values())


def _leading(state: SearchState) -> _Pairs:
    """The leading pairs that leave clearly less than single effects."""
    pairs = leaving_clearly_less(state.pairs, state.singles)
    return _fits(near_the_best(pairs, state.singles, TRIPLE_BASES))


def _others(state: SearchState, asked: _Pairs) -> _Pairs:
    """The next pairs: what leads of two effects need not be two of the three."""
    distinct = {pair.names: pair for pair in sorted(state.pairs, key=lambda c: -c.score)}
    clear = leaving_clearly_less(tuple(distinct.values()), state.singles)
    most = len(asked) + TRIPLE_OTHERS
    return _fits([c for c in near_the_best(clear, state.singles, most) if c.names not in asked])


def _explaining(state: SearchState) -> _Pairs:
    """The best explanation if it is a pair, and those about as likely, on the decimated log."""
    best = [pair for pair in state.pairs if {*pair.names} == {*state.best.names}][:1]
    return _fits([*best, *alike_on_the_decimated_log(state.pairs)]) if best else {}


def _fits(pairs: Sequence[Candidate]) -> _Pairs:
    return {pair.names: pair.fit for pair in pairs}


def _worth_a_third(one: Screened, pair: Fit, *, explained: bool) -> bool:
    """Whether the third effect promises enough, of itself and of what the pair leaves."""
    if explained:
        return one.cost < SECOND_LEAVES * pair.cost
    beyond_noise = pair.cost - pair.samples
    return one.gain >= WORTH_FITTING and pair.cost - one.cost >= TRIPLE_SHARE * beyond_noise

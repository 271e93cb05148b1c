"""Where nothing explains a log: elastic tissue that goes along with a sliding shaft.

Tissue that is twisted stays where it is while the shaft slides through; what sticks to the shaft is
dragged along with its twist. Both are elastic tissue, of one name, and differ by little where the needle
moves slowly. So only where no explanation holds, those with elastic tissue are fitted again with tissue
that is dragged, and kept if one holds then.
"""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.effects.tissue_viscoelasticity import EFFECT, dragged_along
from diagnosis.fitting.problem import FitProblem
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.stages.stage import (
    fitted_again,
    leading_on_the_log,
    leading_sets,
    screen_all,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "tissue that goes along"

_ELASTIC = EFFECT.name


def tissue_that_goes_along(state: SearchState, workers: Workers) -> SearchState:
    """The state with elastic tissue that is dragged along, where only that explains the log."""
    state, explained = state.rechecked()
    slides = any(trial.slides for trial in state.problem.log.trials)
    if explained or not slides or not any(_ELASTIC in one.names for one in leading_on_the_log(state)):
        return state
    again, explained = _fitted(state, _leading_with_elastic_tissue(state), workers).rechecked()
    if not explained:
        return state.noting(
            noted(
                STAGE,
                Decision.DROPPED,
                "with tissue dragged along, no explanation reaches the noise either",
            )
        )
    return again.noting(noted(STAGE, Decision.KEPT, "elastic tissue that goes along explains the log"))


def _leading_with_elastic_tissue(state: SearchState) -> list[Candidate]:
    """The leading sets of one, two and three effects on the decimated log that have it."""
    found = []
    for own in (state.singles, state.pairs, state.triples):
        found += leading_sets([one for one in own if _ELASTIC in one.names])
    return found


def _fitted(state: SearchState, leading: Sequence[Candidate], workers: Workers) -> SearchState:
    """Leading sets with tissue that is dragged, and pairs with it, from where they are."""
    begun = replace(
        state,
        problem=_dragged(state.problem),
        coarse=_dragged(state.coarse),
        candidates=(),
        singles=(),
        pairs=(),
        triples=(),
        checked=None,
    )
    starts = {one.names: one.fit.x for one in reversed(leading)}
    made, record = fit_all(
        STAGE, [(begun.coarse, n, x) for n, x in starts.items() if n == (_ELASTIC,)], workers
    )
    beside = [
        (begun.coarse, one.fit, name) for one in made for name in state.effects if name != _ELASTIC
    ]
    pairs, more = screen_all(STAGE, beside, workers)
    starts |= {one.names: one.fit.x for one in made}
    calls = [(begun.coarse, names, x) for names, x in starts.items()]
    return fitted_again(STAGE, begun.noting(*record, *more), calls, workers, pairs)


def _dragged(problem: FitProblem) -> FitProblem:
    library = {**problem.library, _ELASTIC: dragged_along(problem.library[_ELASTIC])}
    return replace(problem, library=library, log=replace(problem.log, tissue_dragged=True))

"""Single effects, all screened; the promising are fitted."""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.criteria.selection import PAIR_BASES, WORTH_FITTING
from diagnosis.fitting.fit import fit_effects
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.fitting import fit_finalists
from diagnosis.selection.record import failed
from diagnosis.selection.screened_fits import fit_screened
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages.stage import not_worth, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Failure, Task, Workers


def single_effects(state: SearchState, workers: Workers) -> SearchState:
    """Every effect screened, the promising fitted on the decimated log, the best on the log itself.

    What was fitted before, with another noise, starts from where it was.
    """
    stage = "single effects"
    alone = [Task(effects=(), arguments=(state.coarse, ()))]
    (start,) = workers.each(f"screening {stage}", fit_effects, alone)
    if isinstance(start, Failure):
        return state.noting(*failed(stage, [start]))
    screened, record = screen_all(
        stage, [(state.coarse, start, effect) for effect in state.effects], workers
    )
    state = state.noting(*record)
    worth = [s for s in screened if _missing(candidate(start)) or s.gain >= WORTH_FITTING]
    state = state.noting(*not_worth(stage, screened, worth))
    starts = _from_where_they_were(worth, state.singles)
    singles, record = fit_screened(stage, state.coarse, starts, len(starts), workers, used=PAIR_BASES)
    state = replace(state.noting(*record), singles=tuple(singles))
    return state.adding(fit_finalists("finalists", state.problem, singles, workers))


def _missing(scatter: Candidate) -> bool:
    """Whether scatter may have taken over a part of what is missing, so that screening is blind."""
    return not scatter.floor.small or bool(scatter.scatter_named) or scatter.jointly_significant


def _from_where_they_were(worth: Sequence[Screened], fitted: Sequence[Candidate]) -> list[Screened]:
    """Starts of fits: of sets that were fitted before, where that fit ended."""
    known = {c.names: c.fit for c in fitted}
    again = {s.names: s for s in reversed(worth) if s.names in known}
    return [
        *(replace(s, start=known[n].x, cost=min(s.cost, known[n].cost)) for n, s in again.items()),
        *(s for s in worth if s.names not in known),
    ]

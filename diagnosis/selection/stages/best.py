"""The best explanation taken apart: each of its effects alone, its fit to the end, its scatter."""

from diagnosis.fitting.fit_status import Termination
from diagnosis.selection.fitting import fit_all, fit_each_alone
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def best_to_its_end(state: SearchState, workers: Workers) -> SearchState:
    """The fit of the best, where it was given up for staying far above the noise."""
    best = state.best
    if best.fit.status.termination is not Termination.BEHIND:
        return state
    return state.adding(fit_all("best to its end", [(state.problem, best.names, best.fit.x)], workers))


def effects_of_the_best_alone(state: SearchState, workers: Workers) -> SearchState:
    """Each effect of a leading pair alone: the other may have been a crutch."""
    best = state.best
    if len(best.names) < 2:
        return state
    return state.adding(
        fit_each_alone("effects of the best alone", state.problem, best, best.names, workers)
    )


def scatter_of_the_best(state: SearchState, workers: Workers) -> SearchState:
    """What the best names of stiffness and damping, without the prior of scatter that pulls it."""
    best = state.best
    if not best.scatter_named:
        return state
    names = (*best.names, *best.scatter_named)
    start = state.problem.parameterization(names).joined(best.fit.parts)
    return state.adding(fit_all("scatter of the best", [(state.problem, names, start)], workers))

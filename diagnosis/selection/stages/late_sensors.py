"""Why a sensor is late: a delay, a filter or a clock in place of one another in what explains a log."""

from collections.abc import Sequence

from diagnosis.criteria.selection import FINALISTS, SIMPLE_LEAD
from diagnosis.effects import FITTED, IMPERFECTIONS, LIBRARY
from diagnosis.effects.effect import Effect, Place
from diagnosis.log.trial import SENSORS
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import Made, fit_beside
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def imperfections_in_place(state: SearchState, workers: Workers) -> SearchState:
    """The best with another reason for which a sensor is late in place of the one that it has.

    That is a delay, or an imperfection. The decimated log is too coarse to tell a delay from a low pass,
    and what leads there may be the only one that came this far. Two of them may be a third one. Those
    that are about as likely as the best get delays in place of what they have.
    """
    best = state.best
    state, _ = state.rechecked()
    if not state.at_the_floor(best):
        return state
    state = state.adding(_in_place(state, best, [*FITTED], workers))
    for rival in _as_likely(state, best):
        state = state.adding(_in_place(state, rival, [*LIBRARY], workers))
    return state


def _as_likely(state: SearchState, best: Candidate) -> list[Candidate]:
    """Others at the noise floor that are behind the best by little."""
    near = [c for c in state.candidates if c.floor.reached and c.score - best.score <= SIMPLE_LEAD]
    return [c for c in sorted(near, key=lambda c: c.score) if c is not best][: FINALISTS - 1]


def _in_place(state: SearchState, one: Candidate, effects: Sequence[str], workers: Workers) -> Made:
    """An explanation with each of these effects that make a sensor late in place of the one it has."""
    known = {frozenset(c.names) for c in state.candidates}
    swapped: dict[frozenset[str], tuple[str, ...]] = {}
    for column in SENSORS:
        lags = [e.name for e in FITTED.values() if e.needs == column and _is_in_time(e)]
        for late in (name for name in one.names if name in lags and FITTED[name].delays_a_sensor):
            others = tuple(name for name in one.names if name != late)
            bare = tuple(name for name in others if name not in lags)
            new = [lag for lag in lags if lag in effects]
            for names in ((*kept, lag) for kept in (others, bare) for lag in new if lag not in kept):
                swapped.setdefault(frozenset(names), names)
    sets = [names for key, names in swapped.items() if key not in known]
    return fit_beside("imperfections in place", state.problem, one, sets, workers)


def _is_in_time(effect: Effect) -> bool:
    """Whether it is a delay of a sensor, a low pass or a clock."""
    return effect.delays_a_sensor or (effect.place is Place.SENSOR and effect.name in IMPERFECTIONS)

"""Where nothing explains a log: a clock that drifts, and ran before the trials.

Clocks agree when they are set, which may be before a trial, as of a recording that was cut, or of a
session. At time t of a trial a sensor whose clock is off by a rate then shows what was at

    t + rate (t + before),

where it ran for so long before. What is fitted without that is a delay that is another one in each
trial. So where a leading explanation has such a clock, the leading ones are fitted again with a time
before each trial, which is open: on the decimated log, and on the log itself what comes near the noise
there, the best also without each of its effects. It is kept if the log is explained so.
"""

from dataclasses import replace

from diagnosis.effects import FITTED
from diagnosis.fitting.nuisance import clock_starts_of
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.stages.best import best_without_each_effect
from diagnosis.selection.stages.stage import leading_on_the_log, near_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "clocks before trials"
_CLOCKS = ("tip_clock", "torque_clock")


def clocks_before_trials(state: SearchState, workers: Workers) -> SearchState:
    """The state with clocks that ran before the trials, where only that explains the log."""
    state, explained = state.rechecked()
    if explained:
        return state
    begun = _with_clock_starts(state)
    if begun is state:
        return state
    begun = near_fitted_again(STAGE, state, begun, workers)
    again, explained = state, False
    if begun.candidates:
        again, explained = best_without_each_effect(begun, workers).rechecked()
    if not explained:
        why = "with clocks that ran before, no explanation reaches the noise either"
        return state.noting(noted(STAGE, Decision.DROPPED, why))
    return again.noting(noted(STAGE, Decision.KEPT, "clocks that ran before the trials explain the log"))


def _with_clock_starts(state: SearchState) -> SearchState:
    """The state to which nothing is fitted, with a time before each trial; itself: no clock drifts."""
    names = {name for c in leading_on_the_log(state) for name in c.names}
    log = state.problem.log
    starts = tuple(
        effect
        for clock in _CLOCKS
        if clock in names
        for effect in clock_starts_of(log, FITTED[clock].needs)
    )
    if not starts:
        return state
    fine, coarse = (replace(p, nuisance=(*p.nuisance, *starts)) for p in (state.problem, state.coarse))
    return replace(state, problem=fine, coarse=coarse, candidates=(), checked=None)

"""The nominal rig: exactly as rig.yaml says, and within the scatter of its constants."""

from diagnosis.criteria import NOMINAL_LEAD, SCATTER
from diagnosis.selection.candidate import candidate
from diagnosis.selection.fitting import fit_all, fit_each_alone
from diagnosis.selection.record import dropped, kept
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def nominal_rig(state: SearchState, workers: Workers) -> SearchState:
    """The nominal rig, and the nominal rig with its scatter if that is needed."""
    stage = "nominal rig"
    exact = candidate(state.nominal)
    state = state.adding(([exact], kept(stage, [exact], "as rig.yaml says")))
    scattered, record = fit_all(stage, [(state.problem, ())], workers)
    enough = exact.floor.reached and all(exact.score <= s.score + NOMINAL_LEAD for s in scattered)
    if enough:
        return state.noting(*record, *dropped(stage, scattered, "the exact nominal rig is as good"))
    return state.adding((scattered, record))


def stiffness_or_damping_alone(state: SearchState, workers: Workers) -> SearchState:
    """Where only the ratio of both shows, each alone."""
    for one in [c for c in state.candidates if c.unidentifiable]:
        made = fit_each_alone("stiffness or damping alone", state.problem, one, SCATTER, workers)
        state = state.adding(made)
    return state

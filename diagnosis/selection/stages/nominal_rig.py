"""The nominal rig: exactly as rig.yaml says, and within the scatter of its constants."""

from diagnosis.criteria import SCATTER
from diagnosis.selection.candidate import candidate
from diagnosis.selection.fitting import fit_all, fit_each_alone
from diagnosis.selection.record import kept
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers


def nominal_rig(state: SearchState, workers: Workers) -> SearchState:
    """The nominal rig, exactly and with its scatter."""
    stage = "nominal rig"
    exact = candidate(state.nominal)
    state = state.adding(([exact], kept(stage, [exact], "as rig.yaml says")))
    return state.adding(fit_all(stage, [(state.problem, ())], workers))


def stiffness_or_damping_alone(state: SearchState, workers: Workers) -> SearchState:
    """Where only the ratio of both shows, each alone."""
    for one in [c for c in state.candidates if c.unidentifiable]:
        made = fit_each_alone("stiffness or damping alone", state.problem, one, SCATTER, workers)
        state = state.adding(made)
    return state

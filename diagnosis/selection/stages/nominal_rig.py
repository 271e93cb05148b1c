"""The nominal rig: exactly as rig.yaml says, and within the scatter of its constants."""

from diagnosis.criteria.fitting import SCATTER
from diagnosis.selection.candidate import candidate
from diagnosis.selection.fitting import fit_all, fit_beside
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
    """Where only the ratio of both shows, each alone, beside the imperfections of the explanation."""
    known = {frozenset(c.names) for c in state.candidates}
    best = state.best
    if not best.unidentifiable:
        return state
    sets = [(*best.names, name) for name in SCATTER]
    new = [names for names in sets if frozenset(names) not in known]
    return state.adding(fit_beside("stiffness or damping alone", state.problem, best, new, workers))

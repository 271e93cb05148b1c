"""Noise of a sensor that is another one in each trial, where nothing explains the log without it.

It is kept whether the leading explanations, fitted once more, explain the log then or not: it is seen in
differences (prepare/noise/noise_of_trials), whatever is missing.
"""

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.noise_of_trials import NoiseOfTrials, noise_of_trials
from diagnosis.selection.stages.sensors.noise_sizes import fitted_with_sizes, left_at_samples
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "noise of each trial"


def noise_of_each_trial(state: SearchState, workers: Workers) -> SearchState:
    """The state in which the noise of trials differs, where nothing explains the log and it does."""
    state, explained = state.rechecked()
    found = {} if explained else _found(state.problem, state.best.fit)
    return fitted_with_sizes(STAGE, state, found, workers) if found else state


def _found(problem: FitProblem, fit: Fit) -> dict[str, NoiseOfTrials]:
    """How large the noise of each sensor is in each trial, where it differs."""
    found = {s: noise_of_trials(left) for s, left in left_at_samples(problem, fit).items()}
    return {s: own for s, own in found.items() if own}

"""Noise of a sensor that is another one in each trial, where nothing explains the log without it."""

from diagnosis.prepare.noise.noise_of_trials import noise_of_trials
from diagnosis.selection.stages.sensors.noise_sizes import with_varying_noise
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "noise of each trial"


def noise_of_each_trial(state: SearchState, workers: Workers) -> SearchState:
    """The state in which the noise of trials differs, where nothing explains the log and it does."""
    return with_varying_noise(STAGE, state, lambda _, __, left: noise_of_trials(left), workers)

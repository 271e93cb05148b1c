"""Noise of a sensor that grows with rate or torque, where nothing explains the log without it.

Samples then count by what their noise is. That changes what is likeliest, so that the leading
explanations are fitted once more. It is kept whether they explain the log then or not: that the noise
grows is seen in its differences (prepare/noise/growing_noise), and drift or jumps may lie beside it.
"""

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.growing_noise import GrowingNoise, growing_noise
from diagnosis.selection.stages.sensors.noise_sizes import fitted_with_sizes, left_at_samples
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "noise that grows"


def noise_that_grows(state: SearchState, workers: Workers) -> SearchState:
    """The state in which the noise of sensors grows, where nothing explains the log and it does."""
    state, explained = state.rechecked()
    found = {} if explained else _found(state.problem, state.best.fit)
    return fitted_with_sizes(STAGE, state, found, workers) if found else state


def _found(problem: FitProblem, fit: Fit) -> dict[str, GrowingNoise]:
    """How the noise of each sensor grows, of those whose noise is white."""
    read = left_at_samples(problem, fit)
    white = (s for s in SENSORS if s in read and s not in problem.noise.colour)
    found = {s: growing_noise(problem.log, read[s]) for s in white}
    return {s: own for s, own in found.items() if own}

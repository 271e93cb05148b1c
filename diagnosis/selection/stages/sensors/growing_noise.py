"""Noise of a sensor that grows with rate or torque, where nothing explains the log without it.

It is looked for where the noise is white: drift or jumps may lie beside it.
"""

from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.growing_noise import GrowingNoise, growing_noise
from diagnosis.selection.stages.sensors.noise_sizes import Left, with_varying_noise
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "noise that grows"


def noise_that_grows(state: SearchState, workers: Workers) -> SearchState:
    """The state in which the noise of sensors grows, where nothing explains the log and it does."""
    return with_varying_noise(STAGE, state, _found, workers)


def _found(problem: FitProblem, sensor: str, left: Left) -> GrowingNoise | None:
    return None if sensor in problem.noise.colour else growing_noise(problem.log, left)

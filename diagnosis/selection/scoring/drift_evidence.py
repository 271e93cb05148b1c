"""How well a drift of a sensor explains what an explanation leaves, whatever the drift was.

Scores of explanations with and without drift are comparable once what allowing for it costs is added:
the cost of a residual with noise of covariance C is r' C^-1 r + log det C, and a drift changes both
(prepare/noise/drift).
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from diagnosis.criteria.noise import DRIFT_ALLOWED_SIGMA, DRIFT_SIZES_SIGMA
from diagnosis.criteria.selection import MOST_QUIETENED
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.candidate import Candidate, candidate


def in_noise(one: Candidate, problem: FitProblem, noise: Noise) -> Candidate:
    """A candidate of the problem where it is, under another noise."""
    return candidate(rescaled(one.fit, problem, noise))


def score_beside_drift(one: Candidate, problem: FitProblem) -> float:
    """Score of a candidate of the problem, with what allowing for its drift costs."""
    return one.score + _allowance(problem)


def likeliest_drift(problem: FitProblem, sensor: str, found: Sequence[Candidate], zeroed: bool) -> Noise:
    """The problem's noise with the drift under which the best of some candidates has the least score.

    Args:
      sensor: that drifts.
      found: candidates of the problem; at least one.
      zeroed: whether the drift begins at zero in every trial.
    """
    options = list(_noises(problem, sensor, DRIFT_SIZES_SIGMA, zeroed))
    return min(options, key=lambda noise: _least_score(problem, found, noise))


def wide_drifts(problem: FitProblem, sensor: str) -> list[Noise]:
    """The problem's noise with large drifts of a sensor, whatever they begin at: wide, then wider."""
    return list(_noises(problem, sensor, DRIFT_ALLOWED_SIGMA, zeroed=False))


def noise_of_a_reading(problem: FitProblem, sensor: str) -> float:
    """As found, or as claimed, if that is more; that of a single reading where samples have less."""
    found, claimed = problem.noise[sensor], problem.log.rig.sensors.by_column()[sensor]
    left = problem.log.noise_left.get(sensor, 1.0) / float(np.sqrt(problem.log.means_of))
    return max(found, min(claimed, MOST_QUIETENED * found)) / left


def _noises(
    problem: FitProblem, sensor: str, sizes_sigma: Iterable[float], zeroed: bool
) -> Iterable[Noise]:
    one_sigma = noise_of_a_reading(problem, sensor)
    for size_sigma in sizes_sigma:
        allowed = AllowedDrift(size=size_sigma * one_sigma, zeroed=zeroed)
        yield problem.noise.with_drift(sensor, allowed)


def _least_score(problem: FitProblem, found: Sequence[Candidate], noise: Noise) -> float:
    return min(in_noise(one, problem, noise).score for one in found) + _allowance(
        replace(problem, noise=noise)
    )


def _allowance(problem: FitProblem) -> float:
    return sum(_allowance_of(problem, sensor) for sensor in problem.noise.drifts)


def _allowance_of(problem: FitProblem, sensor: str) -> float:
    drift = problem.noise.drift(sensor)
    if drift is None:
        return 0.0
    read = [t for t in problem.log.trials if t.has(sensor)]
    return sum(drift.uncertainty(t.time_s[np.isfinite(t.readings[sensor])]) for t in read)

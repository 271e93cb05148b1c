"""How well a drift of the torque sensor explains what an explanation leaves, whatever the drift was.

Scores of explanations with and without drift are comparable once what allowing for it costs is added:
the cost of a residual with noise of covariance C is r' C^-1 r + log det C, and a drift changes both
(prepare/noise/drift).
"""

from collections.abc import Iterable, Sequence
from dataclasses import replace

import numpy as np

from diagnosis.criteria import DRIFT_SIZES_SIGMA, MOST_QUIETENED
from diagnosis.fitting.noise_reestimation import rescaled
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.sensor_noise import TORQUE, Noise
from diagnosis.selection.candidate import Candidate, candidate


def in_noise(one: Candidate, problem: FitProblem, noise: Noise) -> Candidate:
    """A candidate of the problem where it is, under another noise."""
    return candidate(rescaled(one.fit, problem, noise))


def score_beside_drift(one: Candidate, problem: FitProblem) -> float:
    """Score of a candidate of the problem, with what allowing for its drift costs."""
    return one.score + _allowance(problem)


def likeliest_drift(problem: FitProblem, found: Sequence[Candidate], zeroed: bool) -> Noise:
    """The problem's noise with the drift under which the best of some candidates has the least score.

    Args:
      found: candidates of the problem; at least one.
      zeroed: whether the drift begins at zero in every trial.
    """
    options = list(_noises(problem, zeroed))
    return min(options, key=lambda noise: _least_score(problem, found, noise))


def widest_drift(problem: FitProblem) -> Noise:
    """The problem's noise with the largest drift, whatever it begins at."""
    return max(_noises(problem, zeroed=False), key=lambda noise: noise.torque_drift_n_mm)


def noise_of_a_reading_n_mm(problem: FitProblem) -> float:
    """As found, or as claimed, if that is more; of samples that are means, that of a single reading."""
    found, claimed = problem.noise[TORQUE], problem.log.rig.sensors.base_torque_noise_n_mm
    return float(np.sqrt(problem.log.means_of)) * max(found, min(claimed, MOST_QUIETENED * found))


def _noises(problem: FitProblem, zeroed: bool) -> Iterable[Noise]:
    for size_sigma in DRIFT_SIZES_SIGMA:
        size_n_mm = size_sigma * noise_of_a_reading_n_mm(problem)
        yield replace(problem.noise, torque_drift_n_mm=size_n_mm, torque_zeroed=zeroed)


def _least_score(problem: FitProblem, found: Sequence[Candidate], noise: Noise) -> float:
    return min(in_noise(one, problem, noise).score for one in found) + _allowance(
        replace(problem, noise=noise)
    )


def _allowance(problem: FitProblem) -> float:
    drift = problem.noise.drift(TORQUE)
    if drift is None:
        return 0.0
    torques = [t for t in problem.log.trials if t.has(TORQUE)]
    return sum(drift.uncertainty(t.time_s[np.isfinite(t.readings[TORQUE])]) for t in torques)

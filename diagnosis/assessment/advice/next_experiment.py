"""The run that would best tell two explanations apart, or narrow a parameter, by simulating candidates.

The log shows what the rig can do: depths, free lengths, axial speeds and rates of turning are
taken from there (experiments.py). Both explanations predict each candidate run. Their difference d
/ noise, minus what either could compensate by moving its parameters within the uncertainty that
the log leaves, gives the expected separation

    sqrt(d' (1 + Ja Ca Ja' + Jb Cb Jb')^-1 d),

in standard deviations of a test between the two. If one explanation is left, the same slopes give
the covariance of its parameters after a run: C (1 + J' J C)^-1.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.advice.experiments import SAMPLE_S, Experiment
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.replay import predict
from diagnosis.replay.resolution import COARSE

Array = NDArray[np.float64]

_DIFFERENCE = 1e-3


@dataclass(frozen=True, kw_only=True)
class Proposal:
    """A run, and by how many standard deviations it would tell two explanations apart."""

    experiment: Experiment
    separation: float


def best_experiment(
    problem: FitProblem, one: Fit, other: Fit, feasible: Iterable[Experiment]
) -> Proposal:
    """The feasible run that separates two fits best."""
    proposals = [Proposal(experiment=e, separation=separation(problem, e, one, other)) for e in feasible]
    return max(proposals, key=lambda p: p.separation)


@dataclass(frozen=True, kw_only=True)
class Narrowing:
    """A run, and the factor by which it would narrow the interval of a parameter."""

    experiment: Experiment
    factor: float


def narrowest(problem: FitProblem, fit: Fit, entry: int, feasible: Iterable[Experiment]) -> Narrowing:
    """The feasible run that narrows one entry of a fit's vector most."""
    runs = [Narrowing(experiment=e, factor=narrowing(problem, e, fit, entry)) for e in feasible]
    return min(runs, key=lambda run: run.factor)


def narrowing(problem: FitProblem, experiment: Experiment, fit: Fit, entry: int) -> float:
    """Standard deviation of an entry of the vector after a run / before it; 1: no change."""
    _, slopes = _outlook(problem, experiment.trial, fit)
    own = _root(fit)[entry]
    after = np.linalg.solve(np.eye(own.size) + slopes.T @ slopes, own)
    return float(np.sqrt(max(float(own @ after), 0.0) / float(own @ own)))


def separation(problem: FitProblem, experiment: Experiment, one: Fit, other: Fit) -> float:
    """Expected separation of two fits by a run, in standard deviations, with the sensors of the log."""
    a, spread_a = _outlook(problem, experiment.trial, one)
    b, spread_b = _outlook(problem, experiment.trial, other)
    d = a - b
    loose = np.concatenate([spread_a, spread_b], axis=1)
    # Woodbury: (1 + L L')^-1 d, with the few columns of L.
    held = np.linalg.solve(np.eye(loose.shape[1]) + loose.T @ loose, loose.T @ d)
    return float(np.sqrt(max(float(d @ d - (loose.T @ d) @ held), 0.0)))


def _outlook(problem: FitProblem, trial: PreparedTrial, fit: Fit) -> tuple[Array, Array]:
    """Readings / sigma that a fit predicts, and their slopes with the uncertainty of its parameters."""
    steps = np.vstack([np.zeros(fit.x.size), _DIFFERENCE * np.eye(fit.x.size)])
    rigs = [fit.parameterization.rig(fit.x + step) for step in steps]
    per_sample = float(np.sqrt(SAMPLE_S / problem.log.trials[0].sample_s))
    seen = [s for s in SENSORS if any(t.has(s) for t in problem.log.trials)]
    readings = [
        np.concatenate(
            [problem.noise.whitened(s, trial.time_s, p[s] / problem.noise[s]) * per_sample for s in seen]
        )
        for p in predict(problem.log.rig, trial, rigs, COARSE)
    ]
    slopes = [(moved - readings[0]) / _DIFFERENCE for moved in readings[1:]]
    if not slopes:
        return readings[0], np.zeros((readings[0].size, 0))
    return readings[0], np.stack(slopes, axis=-1) @ _root(fit)


def _root(fit: Fit) -> Array:
    """A root L of the covariance of a fit's vector, L L' = C, (n, n)."""
    spread = np.linalg.pinv(information(fit)) + 1e-12 * np.eye(fit.x.size)
    return np.asarray(np.linalg.cholesky(spread), float)

"""Noise re-estimated from what the best explanation leaves.

Fourth differences see the noise whatever the nominal model lacks, but use the data badly: to 2 %
from some thousands of samples. What a good explanation leaves is white, and first differences of it
tell the noise to 1 %. They are believed as far as they are within 8 % of the first estimate: beyond,
something fast is left in them.
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import NOISE_TRUST
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.log.white_noise import white_noise
from diagnosis.prepare.sensor_noise import Noise

Array = NDArray[np.float64]


def reestimated_noise(problem: FitProblem, best: Fit) -> Noise:
    """Noise of the sensors as the best fit leaves it."""
    change = {s: _change(own) for s, own in _by_sensor(problem, best.by_trial).items()}
    least = problem.noise.least
    sigma = {
        s: max(own * change.get(s, 1.0), least.get(s, 0.0)) for s, own in problem.noise.sigma.items()
    }
    return replace(problem.noise, sigma=sigma)


def rescaled(fit: Fit, problem: FitProblem, noise: Noise) -> Fit:
    """A fit of the problem with its residuals, slopes and cost in units of another noise."""
    rows = [
        np.concatenate([np.full(size, noise[s] / problem.noise[s]) for s, size in sizes.items()])
        for sizes in _sizes(problem)
    ]
    by_trial = tuple(r / f for r, f in zip(fit.by_trial, rows, strict=True))
    prior = fit.parameterization.weights * fit.x
    return replace(
        fit,
        by_trial=by_trial,
        jacobian=tuple(j / f[:, None] for j, f in zip(fit.jacobian, rows, strict=True)),
        cost=sum(float(r @ r) for r in by_trial) + float(prior @ prior),
    )


def _change(parts: Sequence[Array]) -> float:
    """Noise over its first estimate, from residuals in units of that."""
    found = white_noise(parts, order=1)
    return float(np.clip(found if np.isfinite(found) else 1.0, 1 - NOISE_TRUST, 1 + NOISE_TRUST))


def _sizes(problem: FitProblem) -> list[dict[str, int]]:
    """Readings of each trial, by sensor."""
    return [
        {s: int(np.isfinite(trial.readings[s]).sum()) for s in SENSORS if trial.has(s)}
        for trial in problem.log.trials
    ]


def _by_sensor(problem: FitProblem, by_trial: Sequence[Array]) -> dict[str, list[Array]]:
    found: dict[str, list[Array]] = {}
    for sizes, residual in zip(_sizes(problem), by_trial, strict=True):
        ends = np.cumsum(list(sizes.values()))
        for sensor, part in zip(sizes, np.split(residual, ends[:-1]), strict=True):
            found.setdefault(sensor, []).append(part)
    return found

"""Noise of a sensor that is not of one size, where nothing explains the log without it.

Samples count by what their noise is; what was fitted before is in units of that.
"""

from collections.abc import Callable, Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.noise.varying_noise import VaryingNoise
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.stages.stage import leading_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]
Found = Mapping[str, VaryingNoise]
Left = list[tuple[PreparedTrial, Array]]
Find = Callable[[FitProblem, str, Left], VaryingNoise | None]


def _left_at_samples(problem: FitProblem, fit: Fit) -> dict[str, Left]:
    """By sensor: trials, and what a fit leaves / sigma at their samples, (N,); NaN where not read."""
    read: dict[str, Left] = {}
    each = zip(problem.log.trials, by_trial_and_sensor(problem, fit.by_trial), strict=True)
    for trial, parts in each:
        for sensor, _, left in parts:
            at_samples = np.full(trial.time_s.size, np.nan)
            at_samples[np.isfinite(trial.readings[sensor])] = left
            read.setdefault(sensor, []).append((trial, at_samples))
    return read


def with_varying_noise(stage: str, state: SearchState, find: Find, workers: Workers) -> SearchState:
    """The state in which the noise of sensors varies, where nothing explains the log and it does.

    That changes what is likeliest: the leading explanations are fitted again. It is kept whether they
    explain the log then or not, since it is seen in differences, whatever is missing.

    Args:
      find: how the noise of a sensor varies in what the best explanation leaves of it.
    """
    state, explained = state.rechecked()
    read = {} if explained else _left_at_samples(state.problem, state.best.fit)
    each = {sensor: find(state.problem, sensor, left) for sensor, left in read.items()}
    found = {sensor: own for sensor, own in each.items() if own}
    if not found:
        return state
    begun = _with_sizes(state, found)
    told = (noted(stage, Decision.KEPT, f"{s}: it {own.in_words}") for s, own in found.items())
    made = leading_fitted_again(stage, begun, begun.problem, workers)
    return replace(begun, checked=None).adding(made).noting(*told)


def _with_sizes(state: SearchState, found: Found) -> SearchState:
    """The state with weights of the samples, and what was fitted in units of them."""
    return state.converted(
        _weighted(state.problem, found),
        _weighted(state.coarse, found),
        lambda fit, before, _: _reweighted(fit, before, found),
    )


def _weighted(problem: FitProblem, found: Found) -> FitProblem:
    def weighted(trial: PreparedTrial) -> PreparedTrial:
        own = {s: trial.weights.get(s, 1.0) / varies.sizes(trial) for s, varies in found.items()}
        return replace(trial, weights={**trial.weights, **own})

    log = replace(problem.log, trials=tuple(weighted(trial) for trial in problem.log.trials))
    return replace(problem, log=log, noise=problem.noise.varying(found))


def _reweighted(fit: Fit, problem: FitProblem, found: Found) -> Fit:
    """A fit of the problem, whose noise did not vary so, in units of noise that does."""
    rows = [
        np.concatenate([_sizes(trial, sensor, found) for sensor, _, _ in parts] or [np.zeros(0)])
        for trial, parts in zip(
            problem.log.trials, by_trial_and_sensor(problem, fit.by_trial), strict=True
        )
    ]
    by_trial = tuple(own / size for own, size in zip(fit.by_trial, rows, strict=True))
    return replace(
        fit,
        by_trial=by_trial,
        jacobian=tuple(own / size[:, None] for own, size in zip(fit.jacobian, rows, strict=True)),
        cost=sum(float(own @ own) for own in by_trial) + fit.prior,
    )


def _sizes(trial: PreparedTrial, sensor: str, found: Found) -> Array:
    """Noise at the readings of a sensor, in units of what it was taken for."""
    read = np.isfinite(trial.readings[sensor])
    own = found.get(sensor)
    return own.noise_ratio * own.sizes(trial)[read] if own else np.ones(np.count_nonzero(read))

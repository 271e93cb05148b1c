"""Noise of a sensor that grows with rate or torque, where nothing explains the log without it.

Samples then count by what their noise is. That changes what is likeliest, so that the leading
explanations are fitted once more. It is kept whether they explain the log then or not: that the noise
grows is seen in its differences (prepare/noise/growing_noise), and drift or jumps may lie beside it.
"""

from collections.abc import Mapping, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.growing_noise import GrowingNoise, growing_noise
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.selection.candidate import Candidate, candidate
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.stages.stage import leading_fitted_again
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

Array = NDArray[np.float64]
Growth = Mapping[str, GrowingNoise]

STAGE = "noise that grows"


def noise_that_grows(state: SearchState, workers: Workers) -> SearchState:
    """The state in which the noise of sensors grows, where nothing explains the log and it does."""
    state, explained = state.rechecked()
    found = {} if explained else _found(state.problem, state.best.fit)
    if not found:
        return state
    begun = _grown(state, found)
    told = (noted(STAGE, Decision.KEPT, f"{s}: it {own.in_words}") for s, own in found.items())
    made = leading_fitted_again(STAGE, begun, begun.problem, workers)
    return replace(begun, checked=None).adding(made).noting(*told)


def _found(problem: FitProblem, fit: Fit) -> dict[str, GrowingNoise]:
    """How the noise of each sensor grows, of those whose noise is white."""
    read: dict[str, list[tuple[PreparedTrial, Array]]] = {}
    each = zip(problem.log.trials, by_trial_and_sensor(problem, fit.by_trial), strict=True)
    for trial, parts in each:
        for sensor, _, left in parts:
            at_samples = np.full(trial.time_s.size, np.nan)
            at_samples[np.isfinite(trial.readings[sensor])] = left
            read.setdefault(sensor, []).append((trial, at_samples))
    white = (s for s in SENSORS if s in read and s not in problem.noise.colour)
    found = {s: growing_noise(problem.log, read[s]) for s in white}
    return {s: own for s, own in found.items() if own}


def _grown(state: SearchState, found: Growth) -> SearchState:
    """The state with weights of the samples, and what was fitted in units of them."""
    fine, coarse = _weighted(state.problem, found), _weighted(state.coarse, found)

    def again(own: Sequence[Candidate], of: FitProblem) -> tuple[Candidate, ...]:
        return tuple(candidate(_reweighted(c.fit, of, found)) for c in own)

    return replace(
        state,
        problem=fine,
        coarse=coarse,
        nominal=_reweighted(state.nominal, state.problem, found),
        candidates=again(state.candidates, state.problem),
        singles=again(state.singles, state.coarse),
        pairs=again(state.pairs, state.coarse),
        triples=again(state.triples, state.coarse),
    )


def _weighted(problem: FitProblem, found: Growth) -> FitProblem:
    def weighted(trial: PreparedTrial) -> PreparedTrial:
        own = {s: trial.weights.get(s, 1.0) / growth.sizes(trial) for s, growth in found.items()}
        return replace(trial, weights={**trial.weights, **own})

    log = replace(problem.log, trials=tuple(weighted(trial) for trial in problem.log.trials))
    return replace(problem, log=log, noise=problem.noise.growing(found))


def _reweighted(fit: Fit, problem: FitProblem, found: Growth) -> Fit:
    """A fit of the problem, whose noise did not grow, in units of noise that does."""
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


def _sizes(trial: PreparedTrial, sensor: str, found: Growth) -> Array:
    """Noise at the readings of a sensor, in units of what it was taken for."""
    read = np.isfinite(trial.readings[sensor])
    own = found.get(sensor)
    return own.noise_ratio * own.sizes(trial)[read] if own else np.ones(np.count_nonzero(read))

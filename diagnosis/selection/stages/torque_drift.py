"""Where nothing explains a log: the leading explanations once more, with a torque sensor that may drift.

A drift could take over a part of what friction does, so that it is tried last, and only where it would
take off most of what one of the leading explanations leaves beyond noise. One of more than
DRIFT_RANGE_SIGMA within a trial is none of a sensor that works; and where a constant offset does as
well, it is that, which is an effect of the library.

Sigma is the noise of a reading as the sensor gives it: means and filters quieten it, and leave a drift.
"""

import math
from dataclasses import replace

from diagnosis.criteria import (
    CONTENDING,
    DRIFT_RANGE_SIGMA,
    DRIFT_SHARE,
    DRIFT_SIZE_SIGMA,
    MOST_QUIETENED,
    NEAR_FLOOR,
)
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.drift import TORQUE, drift_range_sigma
from diagnosis.replay.replay import replay
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, RecordEntry, noted
from diagnosis.selection.stages.stage import fitted_again, leading_on_the_log, leading_sets
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "drift of the torque sensor"
_MOST_EFFECTS = 3
_REASON = "it would remove most of the remaining residual"


def drift_of_the_torque_sensor(state: SearchState, workers: Workers) -> SearchState:
    """The state with drift allowed for, where that explains the log; else the state itself."""
    state, explained = state.rechecked()
    if explained:
        return state
    if not any(_promises(state.problem, c) for c in leading_on_the_log(state)):
        return state
    start = _drifting(state)
    again, explained = _refitted(state, start, workers).rechecked()
    if not explained:
        return state.noting(_dropped("no explanation reaches the noise with it"))
    most = _range_sigma(again.problem, again.best.fit)
    if most > DRIFT_RANGE_SIGMA:
        return state.noting(_dropped(f"{most:.1f} sigma within a trial is more than a sensor's drift"))
    level, explained = _with_offset(state, again.best, workers).rechecked()
    return level.noting(_dropped("an offset of the sensor is enough")) if explained else again


def _with_offset(state: SearchState, best: Candidate, workers: Workers) -> SearchState:
    """The state without drift, where the best with it has a constant offset instead."""
    names = (*best.names, "torque_bias")
    if "torque_bias" in best.names or "torque_bias" not in state.effects or len(names) > _MOST_EFFECTS:
        return state
    start = state.problem.parameterization(names).joined(best.fit.parts)
    return state.adding(fit_all(STAGE, [(state.problem, names, start)], workers))


def _promises(problem: FitProblem, one: Candidate) -> bool:
    """Whether a drift would take off most of what an explanation leaves beyond noise."""
    left = _cost_with_drift(problem.drifting(_size_n_mm(problem)), one)
    return one.fit.cost - left > DRIFT_SHARE * max(one.fit.cost - one.fit.prior - one.fit.samples, 0.0)


def _cost_with_drift(drifting: FitProblem, one: Candidate) -> float:
    """Cost of an explanation where it is, on a log that drifts."""
    rig = one.fit.parameterization.rig(one.fit.x)
    return one.fit.prior + sum(float(own[0] @ own[0]) for own in drifting.residuals([rig]))


def _refitted(state: SearchState, start: SearchState, workers: Workers) -> SearchState:
    """What the search has come to, fitted with drift from where it is.

    Of some 450 blind logs, all eleven that drift explains are explained so, and none by a search from
    the beginning, which would double the time.
    """
    contenders = [*leading_sets(state.singles), *leading_sets(state.pairs)]
    costs = [_cost_with_drift(start.coarse, c) for c in contenders]
    least = min(costs, default=math.inf)
    near = [c for c, cost in zip(contenders, costs, strict=True) if cost <= NEAR_FLOOR * least]
    calls = [(start.coarse, c.names, c.fit.x, least + CONTENDING) for c in near]
    return fitted_again(STAGE, start, calls, workers)


def _range_sigma(problem: FitProblem, fit: Fit) -> float:
    predictions = replay(problem.log, fit.parameterization.rig(fit.x), problem.resolution)
    sigma = drift_range_sigma(problem.log, problem.noise, predictions)
    return sigma * problem.noise[TORQUE] / _noise_of_a_reading_n_mm(problem)


def _size_n_mm(problem: FitProblem) -> float:
    return DRIFT_SIZE_SIGMA * _noise_of_a_reading_n_mm(problem)


def _noise_of_a_reading_n_mm(problem: FitProblem) -> float:
    """As found, or as claimed, if that is more; of samples that are means, that of a single reading."""
    found, claimed = problem.noise[TORQUE], problem.log.rig.sensors.base_torque_noise_n_mm
    return math.sqrt(problem.log.means_of) * max(found, min(claimed, MOST_QUIETENED * found))


def _drifting(state: SearchState) -> SearchState:
    """The start of a search on the same log with drift allowed for."""
    size_n_mm = _size_n_mm(state.problem)
    problem = state.problem.drifting(size_n_mm)
    rig = state.nominal.parameterization.rig(state.nominal.x)
    left = tuple(own[0] for own in problem.residuals([rig]))
    return SearchState(
        problem=problem,
        coarse=state.coarse.drifting(size_n_mm),
        effects=state.effects,
        nominal=replace(state.nominal, by_trial=left, cost=sum(float(own @ own) for own in left)),
        record=(*state.record, noted(STAGE, Decision.KEPT, _REASON)),
    )


def _dropped(reason: str) -> RecordEntry:
    return noted(STAGE, Decision.DROPPED, reason)

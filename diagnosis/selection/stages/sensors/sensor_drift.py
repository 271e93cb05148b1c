"""A sensor that drifts, where nothing else explains a log: that of the torque, or else that of the tip.

A drift could take over a part of what friction does, or of what moves the tip, so that it is tried last,
where it would take off most of what one of the leading explanations leaves beyond noise, and slopes
promise that what is left comes near it. The leading explanations are then fitted again with it, the best
of them also without each of its effects: what had taken up a part of the drift is not needed. It is kept
if they explain the log, and if a working sensor may drift so (working_sensor). (An offset beside
it does not count before it is told from a drift.) And where one jump of its readings is likelier than a
drift, that is looked at instead (reading_jumps). Both sensors may not drift at once: that explained a
log whose depth was zeroed anew in each trial, beside effects that were not there.
"""

import math
from dataclasses import replace

from diagnosis.criteria.selection import (
    CONTENDING,
    DRIFT_PREDICTED_GAP,
    DRIFT_SHARE,
    JUMP_LEAST_SAMPLES,
    JUMP_PARAMETERS,
    NEAR_FLOOR,
)
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.residuals.largest_step import largest_step
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, RecordEntry, noted
from diagnosis.selection.scoring.beyond_noise import cost_beyond_noise
from diagnosis.selection.scoring.drift_evidence import in_noise, score_beside_drift, wide_drifts
from diagnosis.selection.stages.best import best_without_each_effect
from diagnosis.selection.stages.sensors.reading_jumps import rows_of
from diagnosis.selection.stages.sensors.working_sensor import (
    OFFSETS,
    drifts_too_far,
    with_few_effects,
)
from diagnosis.selection.stages.stage import fitted_again, leading_on_the_log, leading_sets, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

OF_TORQUE, OF_TIP = "drift of the torque sensor", "drift of the tip sensor"
_STAGES = {TORQUE: OF_TORQUE, TIP: OF_TIP}


def drift_of_the_torque_sensor(state: SearchState, workers: Workers) -> SearchState:
    """The state with a drift of the torque allowed for, where only that explains the log."""
    return _with_drift(state, TORQUE, workers)


def drift_of_the_tip_sensor(state: SearchState, workers: Workers) -> SearchState:
    """The state with a drift of the tip's readings allowed for, where only that explains the log."""
    return _with_drift(state, TIP, workers)


def _with_drift(state: SearchState, sensor: str, workers: Workers) -> SearchState:
    """The state with drift of a sensor allowed for, where only that explains the log; else itself."""
    state, explained = state.rechecked()
    if explained or not any(trial.has(sensor) for trial in state.problem.log.trials):
        return state
    leading = leading_on_the_log(state)
    noises = wide_drifts(state.problem, sensor)
    promising = [noise for noise in noises if any(promises(state, noise, c) for c in leading)]
    near = [noise for noise in promising if _comes_near(state, noise)]
    for noise in near:
        again = _searched_again(state, sensor, noise, workers)
        again = with_few_effects(again, sensor, beside=(OFFSETS[sensor],))
        again, explained = again.rechecked() if again.candidates else (again, False)
        if explained:
            why_not = _objection(state, again, sensor)
            return state.noting(_dropped(sensor, why_not)) if why_not else again
    how = "reaches" if near else "comes near"
    return (
        state.noting(_dropped(sensor, f"no explanation {how} the noise with it")) if promising else state
    )


def _objection(state: SearchState, drifting: SearchState, sensor: str) -> str:
    """Why a drift with which the log is explained does not count; empty: it does."""
    if _jumps_rather(state, drifting, sensor):
        return "one jump of its readings leaves less"
    return drifts_too_far(drifting, sensor)


def promises(state: SearchState, noise: Noise, one: Candidate) -> bool:
    """Whether a drift would take off most of what an explanation leaves beyond noise."""
    taken_off = one.fit.cost - in_noise(one, state.problem, noise).fit.cost
    return taken_off > DRIFT_SHARE * cost_beyond_noise(one.fit)


def _comes_near(state: SearchState, noise: Noise) -> bool:
    """Whether slopes promise that an explanation comes near the noise, on this log or the decimated."""
    rare = state.renoised(noise).coarse.noise
    found = [in_noise(c, state.problem, noise).fit for c in leading_on_the_log(state)]
    found += [in_noise(c, state.coarse, rare).fit for c in (*state.singles, *state.pairs)]
    left = (max(fit.predicted_cost - fit.prior, 0.0) / max(fit.samples, 1) for fit in found)
    return math.sqrt(min(left)) <= DRIFT_PREDICTED_GAP


def _jumps_rather(state: SearchState, drifting: SearchState, sensor: str) -> bool:
    """Whether an explanation with one jump of the sensor is likelier than the best with a drift."""
    rows = rows_of(state.problem, sensor)
    steps = [
        (c, largest_step(c.fit.residual, c.fit.slopes, rows, JUMP_LEAST_SAMPLES))
        for c in leading_on_the_log(state)
    ]
    jumped = [
        c.score - step.gain + JUMP_PARAMETERS * math.log(c.fit.samples) for c, step in steps if step
    ]
    return min(jumped, default=math.inf) < score_beside_drift(drifting.best, drifting.problem)


def _searched_again(state: SearchState, sensor: str, noise: Noise, workers: Workers) -> SearchState:
    """What the search has come to, fitted with drift from where it is.

    A drift may have hidden which effect is beside the leading one: all pairs with that are screened. Of
    some 450 blind logs, none that drift explains needed a search from the beginning, which would double
    the time.
    """
    stage, reason = _STAGES[sensor], "it would remove most of the remaining residual"
    drifting = state.renoised(noise).noting(noted(stage, Decision.KEPT, reason))
    start = replace(drifting, candidates=(), singles=(), pairs=(), triples=())
    noise = start.coarse.noise
    known = (state.singles, state.pairs)
    if not state.singles:
        known = _on_the_decimated_log(stage, state, workers)
    sets = ([in_noise(c, state.coarse, noise) for c in own] for own in known)
    contenders = [c for own in sets for c in leading_sets(own)]
    least = min((c.fit.cost for c in contenders), default=float("inf"))
    near = [c for c in contenders if c.fit.cost <= NEAR_FLOOR * least]
    calls = [(start.coarse, c.names, c.fit.x, least + CONTENDING) for c in near]
    singles = sorted((c for c in near if len(c.names) == 1), key=lambda c: c.score)[:1]
    beside = [
        (start.coarse, c.fit, name) for c in singles for name in state.effects if name not in c.names
    ]
    pairs, record = screen_all(stage, beside, workers)
    found = fitted_again(stage, start.noting(*record), calls, workers, pairs)
    return best_without_each_effect(found, workers)


def _on_the_decimated_log(
    stage: str, state: SearchState, workers: Workers
) -> tuple[tuple[Candidate, ...], tuple[Candidate, ...]]:
    """The leading explanations there, of a log whose rows have changed: single effects, and pairs."""
    coarse, leading = state.coarse, [c for c in leading_on_the_log(state) if c.names]
    calls = [(coarse, c.names, coarse.parameterization(c.names).joined(c.fit.parts)) for c in leading]
    found, _ = fit_all(stage, calls, workers)
    singles, pairs = (tuple(c for c in found if len(c.names) == size) for size in (1, 2))
    return singles, pairs


def _dropped(sensor: str, reason: str) -> RecordEntry:
    return noted(_STAGES[sensor], Decision.DROPPED, reason)

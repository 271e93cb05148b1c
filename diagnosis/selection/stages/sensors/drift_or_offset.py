"""A drift of a sensor or an offset of it, which are nearly alike; an offset is an effect of the library.

The best explanation is fitted with and without offset, beside no drift, beside one that begins at zero
in every trial, and beside one that does not; the least score decides (scoring/drift_evidence). An
offset beside a drift shows where trials begin: if they begin at zero, and a drift alone explains the
log, it does, whatever the scores. A drift off zero on average may hide an offset. What a working sensor
does not do (working_sensor) is none of them. And a large drift of the tip beside which nothing is
missing is no defect beside the diagnosis but the diagnosis: the log stays unknown, and the drift is
told as the law that is missing.
"""

from collections.abc import Sequence
from dataclasses import replace

from diagnosis.log.trial import SENSORS, TIP, TORQUE
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.scoring.drift_evidence import likeliest_drift, score_beside_drift, wide_drifts
from diagnosis.selection.stages.sensors.working_sensor import (
    OFFSETS,
    begins_off_zero,
    drifts,
    drifts_too_far,
    is_all_that_is_missing,
    is_off_zero,
    range_sigma,
    what_is_likelier,
    what_it_follows,
    with_few_effects,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "drift or offset"
_WORDS = {TORQUE: "torque", TIP: "tip"}
_MOST_EFFECTS = 3


def drift_or_offset(state: SearchState, workers: Workers) -> SearchState:
    """The likeliest of drifts and none, by sensor, where the best has a drift or an offset of it."""
    for sensor in SENSORS:
        state = _drift_or_offset(state, sensor, workers)
    return state


def _drift_or_offset(state: SearchState, sensor: str, workers: Workers) -> SearchState:
    state, _ = state.rechecked()
    best, drifting = state.best, drifts(state, sensor)
    if not state.at_the_floor(best) or not (drifting or OFFSETS[sensor] in best.names):
        return state
    beside = [_beside(state, sensor, best, zeroed, workers) for zeroed in (True, False)]
    steady = state.problem.noise.with_drift(sensor, None)
    plain = _with_and_without_offset(state, sensor, steady, best, workers)
    few = [with_few_effects(own, sensor) for own in beside]
    working = [own for own in few if own.candidates and _may_be(own, sensor)]
    state = with_few_effects(state, sensor) if drifting else state
    open_to = [own for own in (state, plain, *working) if own.candidates]
    explaining = [own for own, explained in (one.rechecked() for one in open_to) if explained]
    likeliest = min(explaining, key=_score, default=plain)
    if drifts(likeliest, sensor) and OFFSETS[sensor] in likeliest.best.names:
        likeliest = _beginning_at_zero(likeliest, sensor, workers) or likeliest
    if drifts(likeliest, sensor) and (why_not := _objection(plain, likeliest, sensor)):
        return plain.noting(noted(STAGE, Decision.DROPPED, why_not))
    likeliest = likeliest.noting(noted(STAGE, Decision.KEPT, _told(likeliest, sensor)))
    return _without_what_is_hidden(likeliest, sensor)


def _beginning_at_zero(state: SearchState, sensor: str, workers: Workers) -> SearchState | None:
    """The state beside a wide drift without offset, if that explains the log and trials begin at zero.

    Scores are for an offset where drifts go to one side by chance.
    """
    for noise in wide_drifts(state.problem, sensor):
        found, explained = _without_offset(state, sensor, noise, workers).rechecked()
        if explained and _may_be(found, sensor) and not begins_off_zero(found, sensor):
            return found
    return None


def _objection(plain: SearchState, drifting: SearchState, sensor: str) -> str:
    """Why a drift with which the log is explained does not count; empty: it does."""
    if law := what_it_follows(drifting, sensor) or what_is_likelier(plain, drifting, sensor):
        return f"it follows the {law}, as no drift does"
    return "it explains the log without any effect" if is_all_that_is_missing(drifting, sensor) else ""


def _may_be(state: SearchState, sensor: str) -> bool:
    return not drifts_too_far(state, sensor)


def _without_what_is_hidden(state: SearchState, sensor: str) -> SearchState:
    """The state with an offset as an open question, where a drift that begins anywhere may hide it.

    Where every trial begins off zero, nobody knows from which zero the sensor drifted.
    """
    allowed, offset = state.problem.noise.drifts.get(sensor), OFFSETS[sensor]
    if allowed is None or allowed.zeroed or offset not in state.effects:
        return state
    needed = offset in state.best.names
    without = tuple(c for c in state.candidates if offset not in c.names)
    if needed and not any(state.at_the_floor(c) for c in without):
        return state
    state = replace(state, candidates=without)
    hidden = needed or is_off_zero(state, sensor)
    return replace(state, open_effects=(*state.open_effects, offset)) if hidden else state


def _told(state: SearchState, sensor: str) -> str:
    allowed, word = state.problem.noise.drifts.get(sensor), _WORDS[sensor]
    if allowed is None:
        return f"no drift of the {word} is likeliest"
    where = "at zero in every trial" if allowed.zeroed else "anywhere"
    size = f"{range_sigma(state, sensor):.1f} sigma"
    return f"a drift of the {word} by {size} that begins {where} is likeliest"


def _score(state: SearchState) -> float:
    return min(score_beside_drift(c, state.problem) for c in state.candidates if state.at_the_floor(c))


def _beside(
    state: SearchState, sensor: str, best: Candidate, zeroed: bool, workers: Workers
) -> SearchState:
    """The best with and without offset, beside the drift that is then likeliest."""
    first = likeliest_drift(state.problem, sensor, [best], zeroed)
    found = _with_and_without_offset(state, sensor, first, best, workers)
    again = likeliest_drift(found.problem, sensor, found.candidates, zeroed)
    if again.same(first):
        return found
    return _with_and_without_offset(found, sensor, again, found.best, workers)


def _with_and_without_offset(
    state: SearchState, sensor: str, noise: Noise, best: Candidate, workers: Workers
) -> SearchState:
    """The state in that noise, with the best fitted anew there."""
    offset = OFFSETS[sensor]
    without = tuple(name for name in best.names if name != offset)
    having = (*without, offset)
    possible = offset in state.effects and len(having) <= _MOST_EFFECTS
    return _fitted_anew(state, noise, best, (without, having) if possible else (without,), workers)


def _without_offset(state: SearchState, sensor: str, noise: Noise, workers: Workers) -> SearchState:
    """The state in that noise, with the best without its offset, and no other that has one."""
    names = tuple(name for name in state.best.names if name != OFFSETS[sensor])
    found = _fitted_anew(state, noise, state.best, (names,), workers)
    without = tuple(c for c in found.candidates if OFFSETS[sensor] not in c.names)
    return replace(found, candidates=without)


def _fitted_anew(
    state: SearchState,
    noise: Noise,
    best: Candidate,
    sets: Sequence[tuple[str, ...]],
    workers: Workers,
) -> SearchState:
    """The state in that noise, with sets of effects fitted there from where the best is."""
    begun = state.renoised(noise)
    problem = begun.problem
    starts = [(problem, s, problem.parameterization(s).joined(best.fit.parts)) for s in sets]
    others = tuple(c for c in begun.candidates if {*c.names} not in map(set, sets))
    return replace(begun, candidates=others).adding(fit_all(STAGE, starts, workers))

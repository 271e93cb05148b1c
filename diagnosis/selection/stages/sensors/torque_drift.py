"""A torque sensor that drifts: where nothing explains a log, or where an offset of it may be a drift.

A drift could take over a part of what friction does, so that it is tried last, where it would take off
most of what one of the leading explanations leaves beyond noise. And it is nearly an offset, which is an
effect of the library. So the best explanation is fitted with and without offset, beside no drift, beside
one that begins at zero in every trial, and beside one that does not; the least score decides
(scoring/drift_evidence). One that begins off zero in every trial may hide an offset. A drift of more
than DRIFT_RANGE_SIGMA within a trial is none of a sensor that works; nor is one of more than
DRIFT_ALIKE_SIGMA that is the same line in every trial. And it stands beside one effect at most: with two
it takes the shape of what no library holds. (An offset does not count before it is told from a drift.)
Nor does it follow the axial speed. And where one jump of its readings is likelier than a drift, that is
what is looked at next (reading_jumps).

Sigma is the noise of a reading as the sensor gives it: means and filters quieten it, and leave a drift.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from diagnosis.criteria import (
    CONTENDING,
    DRIFT_ALIKE_SIGMA,
    DRIFT_FOLLOWS_SIGMA,
    DRIFT_MOST_EFFECTS,
    DRIFT_RANGE_SIGMA,
    DRIFT_SHARE,
    DRIFT_START_SIGMA,
    JUMP_LEAST_SAMPLES,
    JUMP_PARAMETERS,
    NEAR_FLOOR,
)
from diagnosis.effects import LIBRARY
from diagnosis.prepare.noise.sensor_noise import TORQUE, Noise
from diagnosis.replay.drift import drift_range_sigma, drifts_alike, follows_speed, least_start
from diagnosis.replay.replay import Prediction, replay
from diagnosis.residuals.largest_step import largest_step
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, RecordEntry, noted
from diagnosis.selection.scoring.drift_evidence import (
    in_noise,
    likeliest_drift,
    noise_of_a_reading_n_mm,
    score_beside_drift,
    widest_drift,
)
from diagnosis.selection.stages.sensors.reading_jumps import rows_of
from diagnosis.selection.stages.stage import fitted_again, leading_on_the_log, leading_sets, screen_all
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE, OR_OFFSET = "drift of the torque sensor", "drift or offset"
_OFFSET = "torque_bias"
_MOST_EFFECTS = 3


def drift_of_the_torque_sensor(state: SearchState, workers: Workers) -> SearchState:
    """The state with drift allowed for, where only that explains the log; else the state itself."""
    state, explained = state.rechecked()
    if explained:
        return state
    leading = leading_on_the_log(state)
    widest = widest_drift(state.problem)
    if not any(_promises(state, widest, c) for c in leading):
        return state
    again = _with_few_effects(_searched_again(state, widest, workers), beside=(_OFFSET,))
    again, explained = again.rechecked() if again.candidates else (again, False)
    if not explained:
        return state.noting(_dropped(STAGE, "no explanation reaches the noise with it"))
    if _jumps_rather(state, again):
        return state.noting(_dropped(STAGE, "one jump of its readings leaves less"))
    most = _range_sigma(again)
    if most > _allowed_sigma(again):
        return state.noting(
            _dropped(STAGE, f"{most:.1f} sigma within a trial is more than a sensor's drift")
        )
    return again


def drift_or_offset(state: SearchState, workers: Workers) -> SearchState:
    """The likeliest of drifts and none, where the best has a drift beside it or an offset in it."""
    state, _ = state.rechecked()
    best = state.best
    if not state.at_the_floor(best) or not (_drifts(state) or _OFFSET in best.names):
        return state
    beside = [_beside(state, best, zeroed, workers) for zeroed in (True, False)]
    plain = _with_and_without_offset(state, _without_drift(state), best, workers)
    few = [_with_few_effects(own) for own in beside]
    drifting = [own for own in few if own.candidates and _range_sigma(own) <= _allowed_sigma(own)]
    state = _with_few_effects(state) if _drifts(state) else state
    open_to = [own for own in (state, plain, *drifting) if own.candidates]
    explaining = [own for own, explained in (one.rechecked() for one in open_to) if explained]
    likeliest = min(explaining, key=_score, default=plain)
    if _drifts(likeliest) and _follows_the_speed(likeliest):
        return plain.noting(_dropped(OR_OFFSET, "it follows the axial speed, as no drift does"))
    return _without_what_is_hidden(likeliest).noting(noted(OR_OFFSET, Decision.KEPT, _told(likeliest)))


def _with_few_effects(state: SearchState, beside: Sequence[str] = ()) -> SearchState:
    """The state without explanations that name more effects than may be beside a drift.

    Args:
      beside: effects that do not count.
    """
    counted = set(LIBRARY) - set(beside)
    few = (c for c in state.candidates if len(counted & {*c.names}) <= DRIFT_MOST_EFFECTS)
    return replace(state, candidates=tuple(few))


def _without_what_is_hidden(state: SearchState) -> SearchState:
    """The state with an offset as an open question, where a drift that begins anywhere may hide it.

    Where every trial begins off zero, nobody knows from which zero the sensor drifted.
    """
    if not _drifts(state) or state.problem.noise.torque_zeroed or _OFFSET not in state.effects:
        return state
    needed = _OFFSET in state.best.names
    without = tuple(c for c in state.candidates if _OFFSET not in c.names)
    if needed and not any(state.at_the_floor(c) for c in without):
        return state
    state = replace(state, candidates=without)
    off = least_start(state.problem.log, state.problem.noise, _replayed(state)) > DRIFT_START_SIGMA
    return replace(state, open_effects=(_OFFSET,)) if needed or off else state


def _told(state: SearchState) -> str:
    if not _drifts(state):
        return "no drift is likeliest"
    where = "at zero in every trial" if state.problem.noise.torque_zeroed else "anywhere"
    return f"a drift of {_range_sigma(state):.1f} sigma that begins {where} is likeliest"


def _score(state: SearchState) -> float:
    return min(score_beside_drift(c, state.problem) for c in state.candidates if state.at_the_floor(c))


def _beside(state: SearchState, best: Candidate, zeroed: bool, workers: Workers) -> SearchState:
    """The best with and without offset, beside the drift that is then likeliest."""
    first = likeliest_drift(state.problem, [best], zeroed)
    found = _with_and_without_offset(state, first, best, workers)
    again = likeliest_drift(found.problem, found.candidates, zeroed)
    if again.same(first):
        return found
    return _with_and_without_offset(found, again, found.best, workers)


def _with_and_without_offset(
    state: SearchState, noise: Noise, best: Candidate, workers: Workers
) -> SearchState:
    """The state in that noise, with the best fitted anew there."""
    begun = state.renoised(noise)
    without = tuple(name for name in best.names if name != _OFFSET)
    having = (*without, _OFFSET)
    possible = _OFFSET in state.effects and len(having) <= _MOST_EFFECTS
    sets, problem = (without, having) if possible else (without,), begun.problem
    starts = [(problem, s, problem.parameterization(s).joined(best.fit.parts)) for s in sets]
    others = tuple(c for c in begun.candidates if {*c.names} not in map(set, sets))
    return replace(begun, candidates=others).adding(fit_all(OR_OFFSET, starts, workers))


def _promises(state: SearchState, noise: Noise, one: Candidate) -> bool:
    """Whether a drift would take off most of what an explanation leaves beyond noise."""
    taken_off = one.fit.cost - in_noise(one, state.problem, noise).fit.cost
    return taken_off > DRIFT_SHARE * max(one.fit.cost - one.fit.prior - one.fit.samples, 0.0)


def _jumps_rather(state: SearchState, drifting: SearchState) -> bool:
    """Whether an explanation with one jump of the torque is likelier than the best with a drift."""
    rows = rows_of(state.problem, TORQUE)
    steps = [
        (c, largest_step(c.fit.residual, c.fit.slopes, rows, JUMP_LEAST_SAMPLES))
        for c in leading_on_the_log(state)
    ]
    jumped = [
        c.score - step.gain + JUMP_PARAMETERS * math.log(c.fit.samples) for c, step in steps if step
    ]
    return min(jumped, default=math.inf) < score_beside_drift(drifting.best, drifting.problem)


def _searched_again(state: SearchState, noise: Noise, workers: Workers) -> SearchState:
    """What the search has come to, fitted with drift from where it is.

    A drift may have hidden which effect is beside the leading one: all pairs with that are screened. Of
    some 450 blind logs, none that drift explains needed a search from the beginning, which would double
    the time.
    """
    reason = "it would remove most of the remaining residual"
    drifting = state.renoised(noise).noting(noted(STAGE, Decision.KEPT, reason))
    start = replace(drifting, candidates=(), singles=(), pairs=(), triples=())
    noise = start.coarse.noise
    sets = ([in_noise(c, state.coarse, noise) for c in own] for own in (state.singles, state.pairs))
    contenders = [c for own in sets for c in leading_sets(own)]
    least = min((c.fit.cost for c in contenders), default=float("inf"))
    near = [c for c in contenders if c.fit.cost <= NEAR_FLOOR * least]
    calls = [(start.coarse, c.names, c.fit.x, least + CONTENDING) for c in near]
    singles = sorted((c for c in near if len(c.names) == 1), key=lambda c: c.score)[:1]
    beside = [
        (start.coarse, c.fit, name) for c in singles for name in state.effects if name not in c.names
    ]
    pairs, record = screen_all(STAGE, beside, workers)
    return fitted_again(STAGE, start.noting(*record), calls, workers, pairs)


def _drifts(state: SearchState) -> bool:
    return state.problem.noise.torque_drift_n_mm > 0.0


def _without_drift(state: SearchState) -> Noise:
    return replace(state.problem.noise, torque_drift_n_mm=0.0)


def _range_sigma(state: SearchState) -> float:
    """Largest range of the drift beside the best within a trial, in sigma of a reading."""
    problem = state.problem
    sigma = drift_range_sigma(problem.log, problem.noise, _replayed(state))
    return sigma * problem.noise[TORQUE] / noise_of_a_reading_n_mm(problem)


def _allowed_sigma(state: SearchState) -> float:
    """Range of a drift of a working sensor; less, where it is the same line in every trial."""
    alike = drifts_alike(state.problem.log, state.problem.noise, _replayed(state))
    return DRIFT_ALIKE_SIGMA if alike else DRIFT_RANGE_SIGMA


def _follows_the_speed(state: SearchState) -> bool:
    noise = state.problem.noise
    return abs(follows_speed(state.problem.log, noise, _replayed(state))) > DRIFT_FOLLOWS_SIGMA


def _replayed(state: SearchState) -> list[Prediction]:
    problem, fit = state.problem, state.best.fit
    return replay(problem.log, fit.parameterization.rig(fit.x), problem.resolution)


def _dropped(stage: str, reason: str) -> RecordEntry:
    return noted(stage, Decision.DROPPED, reason)

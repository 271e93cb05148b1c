"""Where no effects explain a log: a reading that jumps within a trial, since an encoder lost counts.

The step in the residual of each leading explanation that takes most off its cost tells sensor, trial
and sample. If that is a good part of what is left beyond noise, the leading explanations are fitted
again with a jump there, whose size is open, in the noise that the best of them then leaves; so are
single effects that promise most beside the jump, which may have hidden them. Once more, if another jump
is left that takes off enough for those that may follow, which are smaller, to take off the rest. It is
allowed for only if the log is explained so, and not as well by a chuck that slipped at that moment, or a
base that lost counts, which move the needle against its reading. That shows for a moment in the torque,
so that a trial has to have both, tip and torque.

Only one sensor may jump: where both do, something has happened to the needle, which no library knows.
A recording may have more than jumps: a drift of the torque is asked for beside the largest one, and
beside all that were found.

It is told beside effects. A jump that explains a log alone is all that the model lacks: the log stays
unknown, and the jump is told as the law that is missing.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from diagnosis.criteria.selection import (
    JUMP_LEAST_SAMPLES,
    JUMP_SHARE,
    JUMPS_SHARE,
    MOST_JUMPS,
    SIMPLE_LEAD,
)
from diagnosis.fitting.nuisance import reading_jump
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import BASE, SENSORS
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.sensing.reading_errors import ReadingJump
from diagnosis.residuals.largest_step import ResidualStep, largest_step
from diagnosis.selection.candidate import Candidate
from diagnosis.selection.fitting import fit_all
from diagnosis.selection.record import Decision, noted
from diagnosis.selection.scoring.beyond_noise import cost_beyond_noise
from diagnosis.selection.screening import Screened
from diagnosis.selection.stages.sensors.coloured_noise import noise_of_the_best
from diagnosis.selection.stages.stage import (
    Stage,
    first_that_explains,
    fitted_again,
    leading_on_the_log,
    leading_sets,
    screen_all,
)
from diagnosis.selection.state import SearchState
from diagnosis.workers import Workers

STAGE = "jumps of readings"


@dataclass(frozen=True, kw_only=True, eq=False)
class _Place:
    """A sensor in a trial, and its rows in the residuals of a fit."""

    trial: PreparedTrial
    sensor: str
    rows: slice


def jumps_and_more(others: Sequence[Stage]) -> Stage:
    """A stage: the state with jumps allowed for, where that explains the log; else the state itself.

    Args:
      others: stages that allow for what else a recording may lack, beside the jumps so far.
    """

    def jumps_of_readings(state: SearchState, workers: Workers) -> SearchState:
        state, explained = state.rechecked()
        if explained:
            return state
        jumping, sensors = state, [*SENSORS]
        for made in range(MOST_JUMPS):
            share = max(JUMP_SHARE, JUMPS_SHARE / (MOST_JUMPS - made))
            jump = _largest_jump(jumping, share, sensors)
            if jump is None:
                break
            sensors = [jump.sensor]
            jumping = _refitted(state, jumping, jump, workers)
            found = _explained(jumping, others, workers)
            if found and (why_not := _objection(found, jump, workers)):
                return state.noting(noted(STAGE, Decision.DROPPED, why_not))
            if found:
                return found.noting(noted(STAGE, Decision.KEPT, "with it the log is explained"))
        if jumping is state:
            return state
        return state.noting(noted(STAGE, Decision.DROPPED, "no explanation reaches the noise with one"))

    return jumps_of_readings


jumps_of_readings = jumps_and_more(())
"""Jumps alone."""


def _explained(jumping: SearchState, others: Sequence[Stage], workers: Workers) -> SearchState | None:
    """The state with a jump, or with one of the others beside it, if that explains the log."""
    again, explained = jumping.rechecked()
    return again if explained else first_that_explains(others, jumping, workers)


def _objection(state: SearchState, jump: ReadingJump, workers: Workers) -> str:
    """Why a jump with which the log is explained does not count; empty: it does."""
    if _explains_alone(state):
        return "it explains the log without any effect"
    return "a slip between base and needle does as well" if _may_be_a_slip(state, jump, workers) else ""


def _explains_alone(state: SearchState) -> bool:
    """Whether the nominal rig explains the log, with what is allowed for."""
    return any(c.explains and not c.named for c in (state.checked.candidates if state.checked else ()))


def _may_be_a_slip(state: SearchState, jump: ReadingJump, workers: Workers) -> bool:
    """Whether the best explanation does as well with the base off at that moment, not the reading."""
    best, others = state.best, state.problem.nuisance[:-1]
    sigma_deg = state.problem.noise["tip_angle_deg"]  # both read the needle, and the base may be exact
    slip = reading_jump(replace(jump, sensor=BASE), sigma=sigma_deg)
    problem = replace(state.problem, nuisance=(*others, slip))
    start = problem.parameterization(best.names).joined(best.fit.parts)
    found, _ = fit_all(STAGE, [(problem, best.names, start)], workers)
    return any(c.fit.cost - best.fit.cost <= SIMPLE_LEAD for c in found)


def _largest_jump(state: SearchState, share: float, sensors: Sequence[str]) -> ReadingJump | None:
    """The jump that leaves least of one of the leading explanations.

    Args:
      share: of what that leaves beyond noise, which it has to take off; None if none does.
      sensors: that may jump.
    """
    places = [place for place in _places(state.problem) if place.sensor in sensors]
    rows = [place.rows for place in places]
    least, found = np.inf, None
    for one in leading_on_the_log(state):
        step = largest_step(one.fit.residual, one.fit.slopes, rows, JUMP_LEAST_SAMPLES)
        if step and _is_enough(step, one, share) and one.fit.cost - step.gain < least:
            least, found = one.fit.cost - step.gain, step
    return _jump(places[found.block], found.sample) if found else None


def _is_enough(step: ResidualStep, one: Candidate, share: float) -> bool:
    return step.gain > share * cost_beyond_noise(one.fit)


def rows_of(problem: FitProblem, sensor: str) -> list[slice]:
    """Rows of a sensor in the residuals of a fit, one slice for each trial with all sensors."""
    return [place.rows for place in _places(problem) if place.sensor == sensor]


def _places(problem: FitProblem) -> Iterator[_Place]:
    """Where a jump may be: the sensors of trials that have all of them."""
    end = 0
    for trial in problem.log.trials:
        for sensor in filter(trial.has, SENSORS):
            start, end = end, end + int(np.isfinite(trial.readings[sensor]).sum())
            if all(map(trial.has, SENSORS)):
                yield _Place(trial=trial, sensor=sensor, rows=slice(start, end))


def _jump(place: _Place, sample: int) -> ReadingJump:
    trial, sensor = place.trial, place.sensor
    time_s = trial.time_s[np.isfinite(trial.readings[sensor])]
    return ReadingJump(trial=trial.name, sensor=sensor, time_s=float(time_s[sample]), size=0.0)


def _refitted(
    state: SearchState, jumping: SearchState, jump: ReadingJump, workers: Workers
) -> SearchState:
    """What the search has come to, fitted with one more jump from where it is.

    Args:
      state: without any jump.
      jumping: with those that were found so far.
    """
    effect = reading_jump(jump, sigma=state.problem.noise[jump.sensor])
    fine, coarse = (
        replace(p, nuisance=(*p.nuisance, effect)) for p in (jumping.problem, jumping.coarse)
    )
    contenders = [*leading_sets(state.singles), *leading_sets(state.pairs)]
    calls = [(coarse, c.names, coarse.parameterization(c.names).joined(c.fit.parts)) for c in contenders]
    start = replace(
        state,
        problem=fine,
        coarse=coarse,
        candidates=(),
        triples=(),
        checked=None,
        record=(*jumping.record, noted(STAGE, Decision.MADE, effect.title)),
    )
    known = {c.names for c in contenders}
    hidden = [name for name in state.effects if (name,) not in known]
    beside = _screened_with(coarse, hidden, workers)
    return noise_of_the_best(fitted_again(STAGE, start, calls, workers, beside), workers)


def _screened_with(coarse: FitProblem, effects: Sequence[str], workers: Workers) -> list[Screened]:
    """What single effects promise beside the jump, which may have hidden them."""
    bare, _ = fit_all(STAGE, [(coarse, ())], workers)
    found, _ = screen_all(STAGE, [(coarse, c.fit, name) for c in bare for name in effects], workers)
    return found

"""A clock that drifts, and ran before the trials, is told where that explains a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, joined, log_with, prepared, start_of_search, trial

from diagnosis.effects import FITTED
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.parameterization import starts
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import TIP, TORQUE, Trial
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors.clock_starts import STAGE, clocks_before_trials
from diagnosis.workers import Workers

RATE, BEFORE_S = -0.01, (5.0, 12.0)
NOISE = {TIP: 0.25, TORQUE: 0.01}


def read(angle, sensor: str, ran_s: float, seed: int) -> RigLog:
    """A nominal rig, a sensor of which has a clock that is slow, and ran for so long before."""
    clean, rng = trial(angle), np.random.default_rng(seed)
    found, time_s = predict(RIG, prepared(clean), [NOMINAL])[0], clean["time_s"]
    slow_s = time_s + RATE * (time_s + ran_s)
    shown = {s: np.interp(slow_s if s == sensor else time_s, time_s, found[s]) for s in NOISE}
    noisy = {s: own + rng.normal(0.0, NOISE[s], time_s.size) for s, own in shown.items()}
    return log_with(Trial(name=clean.name, table=clean.table.assign(**noisy)))


def two_trials(sensor: str, *ran_s: float) -> RigLog:
    """Trials that turn to and fro, and rest at first."""
    swing = 60.0 * np.sin(2 * np.pi * 0.5 * np.clip(np.arange(0.0, 12.0, 0.01) - 0.5, 0.0, None))
    return joined(*(read((1 - 2 * i) * swing, sensor, own, i) for i, own in enumerate(ran_s)))


def searched(log: RigLog, *names: str):
    """What an explanation leaves, then with clocks that ran before."""
    state = nominal_rig(start_of_search(log, effects=()), Workers())
    if names:
        effects = [FITTED[name] for name in names]
        begun = {e.name: starts(e)[-1] for e in effects}  # of a clock: slow
        start = state.problem.parameterization(names).joined(begun)
        state = state.adding(([candidate(fit_effects(state.problem, names, start))], ()))
    return state, clocks_before_trials(state, Workers())


@pytest.mark.parametrize(("sensor", "clock"), [(TIP, "tip_clock"), (TORQUE, "torque_clock")])
def test_a_clock_that_ran_before_is_told_with_the_time_that_it_ran(sensor, clock):
    before, after = searched(two_trials(sensor, *BEFORE_S), clock)
    assert not before.rechecked()[1]
    assert after.rechecked()[1]
    assert after.best.names == (clock,)
    rig = after.best.fit.parameterization.rig(after.best.fit.x)
    ran_s = [one.before_s for one in rig.clock_starts]
    # A time of the sensor is known to some ms, of which 1 % is the time that its clock ran.
    assert ran_s == pytest.approx(BEFORE_S, abs=0.6)
    assert [e.decision for e in after.record if e.stage == STAGE and not e.effects][-1] is Decision.KEPT


def test_where_no_clock_drifts_nothing_is_asked():
    before, after = searched(two_trials(TIP, *BEFORE_S), "tip_sensor_delay")
    assert not before.rechecked()[1]
    assert after.problem is before.problem
    assert [c.names for c in after.candidates] == [c.names for c in before.candidates]


def test_a_log_that_a_clock_explains_is_left_alone():
    before, after = searched(two_trials(TIP, 0.0, 0.0), "tip_clock")
    assert before.rechecked()[1]
    assert (after.problem, after.candidates) == (before.problem, before.candidates)


def test_what_no_clock_does_stays_unexplained():
    log = two_trials(TIP, 0.0, 0.0)
    first, last = log.trials
    off = last.table.assign(**{TIP: last[TIP] + 3.0 * np.sin(last["time_s"])})
    log = replace(log, trials=(first, Trial(name=last.name, table=off)))
    before, after = searched(log, "tip_clock")
    assert after.problem is before.problem
    assert after.record[-1].decision is Decision.DROPPED

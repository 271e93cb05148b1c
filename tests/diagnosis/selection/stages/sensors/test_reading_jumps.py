"""A reading that jumps within a trial is allowed for, where that and an effect explain a log."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of, start_of_search

from diagnosis.fitting.fit import fit_effects
from diagnosis.log.faults.left_out import LeftOut
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import BASE, Trial
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.sensing.reading_errors import ReadingJump
from diagnosis.selection.candidate import candidate
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors import reading_jumps as module
from diagnosis.selection.stages.sensors.reading_jumps import STAGE, jumps_and_more, jumps_of_readings
from diagnosis.selection.stages.sensors.sensor_drift import drift_of_the_torque_sensor
from diagnosis.workers import Workers

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"
NOISE = {TIP: 0.3, TORQUE: 0.015}


def off(log: RigLog, column: str, *jumps: tuple[float, float]) -> RigLog:
    """The log with readings of the last trial that are off by so many sigma from so many seconds on."""
    *others, last = log.trials
    table = last.table.copy()
    for time_s, sigmas in jumps:
        table.loc[table["time_s"] >= time_s, column] += sigmas * NOISE[column]
    return replace(log, trials=(*others, Trial(name=last.name, table=table)))


def two(rig: RigParameters) -> RigLog:
    return joined(log_of(rig, seconds=8.0), log_of(rig, seed=1, speed=-1.0, seconds=8.0))


DRY = RigParameters(kinetic_n_mm_per_mm=0.001)


def searched(log, effects=("coulomb_friction",)):
    """What dry friction leaves, fitted from where it is, then with jumps if that is needed."""
    state = nominal_rig(start_of_search(log, effects=effects), Workers())
    for name in effects:
        start = state.problem.parameterization((name,)).joined({name: np.log([0.001])})
        coarse, fine = (fit_effects(p, (name,), start) for p in (state.coarse, state.problem))
        state = replace(state, singles=(candidate(coarse),)).adding(([candidate(fine)], ()))
    return state, jumps_of_readings(state, Workers())


def decisions(state):
    return [e.decision for e in state.record if e.stage == STAGE and not e.effects and e.score is None]


@pytest.mark.parametrize("column", [TIP, TORQUE])
def test_a_jump_is_found_with_its_time_and_size_beside_an_effect(column):
    before, after = searched(off(two(DRY), column, (5.0, 8.0)))
    assert not before.best.floor.reached
    assert after.best.floor.reached
    assert after.best.names == ("coulomb_friction",)
    assert np.exp(after.best.fit.x[0]) == pytest.approx(0.001, rel=0.02)
    (jump,) = after.best.fit.parameterization.rig(after.best.fit.x).jumps
    assert (jump.sensor, jump.trial) == (column, "trial_02.csv")
    assert jump.time_s == pytest.approx(5.0, abs=0.011)
    assert jump.size == pytest.approx(8.0 * NOISE[column], abs=0.3 * NOISE[column])
    assert decisions(after)[-1] is Decision.KEPT


def hidden(log):
    """A search that has not fitted the dry friction, since a jump makes other effects likelier."""
    return nominal_rig(start_of_search(log, effects=("coulomb_friction",)), Workers())


def test_an_effect_that_the_jump_has_hidden_is_found_beside_it():
    after = jumps_of_readings(hidden(off(two(DRY), TIP, (5.0, 60.0))), Workers())
    assert after.best.floor.reached
    assert after.best.names == ("coulomb_friction",)
    assert len(after.best.fit.parameterization.rig(after.best.fit.x).jumps) == 1


def test_readings_that_were_left_out_stay_so_beside_a_jump():
    """As where outliers are left out first; the report leaves out what the verdict did."""
    left_out = (LeftOut(trial="trial_01.csv", sensor=TIP, times_s=np.array([1.0]), samples=100),)
    before = replace(hidden(off(two(DRY), TIP, (5.0, 60.0))), left_out=left_out, open_effects=("x",))
    after = jumps_of_readings(before, Workers())
    assert after.best.floor.reached
    assert (after.left_out, after.open_effects) == (left_out, ("x",))


def test_what_passed_for_coloured_noise_is_white_where_the_effect_is_found():
    before = hidden(off(two(DRY), TIP, (5.0, 60.0)))
    colour = {TORQUE: NoiseColour.of(share=0.7, correlation_time_s=0.2)}
    noise = replace(before.problem.noise, colour=colour, white=before.problem.noise.sigma)
    after = jumps_of_readings(before.renoised(noise), Workers())
    assert after.problem.noise.colour == {}
    assert after.best.names == ("coulomb_friction",)
    left = np.concatenate(after.best.fit.by_trial)
    assert np.sqrt(np.mean(left**2)) == pytest.approx(1.0, abs=3 / np.sqrt(2 * left.size))


def test_two_jumps_are_found_one_after_the_other():
    _, after = searched(off(two(DRY), TIP, (2.0, 8.0), (6.0, 8.0)))
    assert after.best.floor.reached
    assert len(after.best.fit.parameterization.rig(after.best.fit.x).jumps) == 2


def test_of_both_sensors_no_jumps_are_allowed_for():
    """A tip and a torque that jump at once are the needle's doing, not that of two sensors."""
    tip = off(two(DRY), TIP, (2.0, 8.0))
    before, after = searched(off(tip, TORQUE, (6.0, 2.0)))
    assert after.problem is before.problem
    assert decisions(after)[-1] is Decision.DROPPED


def test_a_jump_alone_is_what_is_missing():
    before, after = searched(off(two(NOMINAL), TIP, (5.0, 8.0)), effects=())
    assert after.problem is before.problem
    assert "without any effect" in [e for e in after.record if e.stage == STAGE][-1].reason


def test_a_log_that_is_explained_is_left_alone():
    before, after = searched(two(DRY))
    assert (after.problem, after.candidates) == (before.problem, before.candidates)
    assert after.record == before.record


def test_what_is_no_jump_is_left_alone():
    """Dry friction leaves much of the nominal rig, and no step takes most of it off."""
    before, after = searched(two(DRY), effects=())
    assert after.problem is before.problem
    assert not before.best.floor.reached
    assert Decision.KEPT not in decisions(after)


def test_without_the_other_sensor_a_jump_may_be_the_needle_itself():
    log = off(two(DRY), TIP, (5.0, 8.0))
    trials = [Trial(name=t.name, table=t.table.drop(columns=TORQUE)) for t in log.trials]
    before, after = searched(replace(log, trials=tuple(trials)))
    assert after.problem is before.problem
    assert not after.best.floor.reached


def test_a_base_that_lost_counts_or_a_chuck_that_slipped_is_no_jump_of_the_tip():
    """A slip of 3 deg twists the needle: the torque tells, until it has relaxed."""
    slip = ReadingJump(trial="trial_02.csv", sensor=BASE, time_s=5.0, size=3.0)
    problem = start_of_search(two(DRY), effects=()).problem
    slipped = [
        predict(problem.log.rig, trial, [DRY, replace(DRY, jumps=(slip,))])
        for trial in problem.log.trials
    ]
    log = two(DRY)
    trials = []
    for trial, (without, with_it) in zip(log.trials, slipped, strict=True):
        change = {name: with_it[name] - without[name] for name in (TIP, TORQUE)}
        table = trial.table.assign(**{name: trial.table[name] + d for name, d in change.items()})
        trials.append(Trial(name=trial.name, table=table))
    before, after = searched(replace(log, trials=tuple(trials)))
    assert not before.best.floor.reached
    assert after.problem is before.problem
    assert decisions(after)[-1] is Decision.DROPPED


def test_where_a_slip_does_as_well_it_stays_open_which_it_is(monkeypatch):
    monkeypatch.setattr(module, "SIMPLE_LEAD", 1e9)
    before, after = searched(off(two(DRY), TIP, (5.0, 8.0)))
    assert after.problem is before.problem
    assert "does as well" in [e for e in after.record if e.stage == STAGE][-1].reason


def drifting(log: RigLog, sigmas: float) -> RigLog:
    """The log with a torque that drifts by so many sigma in each trial."""
    trials = []
    for trial in log.trials:
        drift = np.linspace(0.0, sigmas * NOISE[TORQUE], len(trial.table))
        trials.append(
            Trial(name=trial.name, table=trial.table.assign(**{TORQUE: trial[TORQUE] + drift}))
        )
    return replace(log, trials=tuple(trials))


@pytest.mark.slow
def test_a_drift_is_found_beside_a_jump_where_neither_alone_explains_the_log():
    before, _ = searched(drifting(off(two(DRY), TIP, (5.0, 8.0)), 3.0))
    for alone in (jumps_of_readings, drift_of_the_torque_sensor):
        assert alone(before, Workers()).problem is before.problem
    after = jumps_and_more((drift_of_the_torque_sensor,))(before, Workers())
    assert after.best.floor.reached
    assert after.best.names == ("coulomb_friction",)
    (jump,) = after.best.fit.parameterization.rig(after.best.fit.x).jumps
    assert (jump.sensor, jump.time_s) == (TIP, pytest.approx(5.0, abs=0.011))
    assert [*after.problem.noise.drifts] == [TORQUE]
    assert decisions(after)[-1] is Decision.KEPT


def test_where_no_reading_jumps_nothing_is_asked_beside_one():
    def never(state, workers):
        raise AssertionError("asked")

    before, _ = searched(two(DRY), effects=())
    assert jumps_and_more((never,))(before, Workers()).problem is before.problem


def test_what_else_a_recording_may_lack_is_asked_beside_every_jump(monkeypatch):
    before, _ = searched(two(DRY), effects=())
    jump = ReadingJump(trial="trial_01.csv", sensor=TIP, time_s=2.0, size=0.0)
    found, asked = iter([jump, jump, None]), []

    def other(state, workers):
        asked.append(state.record.count("jumped"))
        return state

    monkeypatch.setattr(module, "_largest_jump", lambda *_: next(found))
    monkeypatch.setattr(module, "_refitted", lambda _, jumping, *__: jumping.noting("jumped"))
    jumps_and_more((other,))(before, Workers())
    assert asked == [1, 2]

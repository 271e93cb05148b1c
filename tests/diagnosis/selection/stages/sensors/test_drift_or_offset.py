"""A drift of a sensor is told from an offset of it, and from what follows the motion."""

import pytest
from diagnosis_fixtures import start_of_search
from drifting_logs import STAGES, moved, off, settling, sliding

from diagnosis.log.trial import SENSORS, TORQUE
from diagnosis.selection.record import Decision
from diagnosis.selection.stages.nominal_rig import nominal_rig
from diagnosis.selection.stages.sensors.drift_or_offset import OFFSETS, STAGE, drift_or_offset
from diagnosis.selection.stages.single_effects import single_effects
from diagnosis.workers import Workers

pytestmark = pytest.mark.parametrize("sensor", SENSORS)


def compared(log, sensor):
    """What the search of a log with the offset of a sensor comes to, drift or not."""
    state = start_of_search(log, effects=(OFFSETS[sensor],))
    for step in (nominal_rig, single_effects, STAGES[sensor], drift_or_offset):
        state = step(state, Workers())
    return state


def test_a_constant_offset_is_an_effect_of_the_library_and_no_drift(sensor):
    after = compared(moved((1.5, 0, 0), (1.5, 0, 0), sensor=sensor), sensor)
    assert after.best.names == (OFFSETS[sensor],)
    assert not after.problem.noise.drifts
    assert after.open_effects == ()


def test_a_drift_that_is_zeroed_before_each_trial_is_no_offset(sensor):
    after = compared(moved((0, 0, 1.5), (0, 0, 1.6), sensor=sensor), sensor)
    assert after.best.names == ()
    assert [*after.problem.noise.drifts] == [sensor]
    assert after.open_effects == ()


def test_an_offset_beside_a_drift_that_is_zeroed_is_told_from_it(sensor):
    after = compared(moved((2.5, 0, 1.5), (2.5, 0, -1.4), (2.5, 0, 1.6), sensor=sensor), sensor)
    assert after.best.names == (OFFSETS[sensor],)
    assert after.problem.noise.drifts[sensor].zeroed


def test_a_drift_that_goes_on_from_zero_is_no_offset(sensor):
    after = compared(moved((0, 0, 2), (0, 2, 4), sensor=sensor), sensor)
    assert after.best.names == ()
    assert after.open_effects == ()


def test_a_drift_that_begins_off_zero_in_every_trial_may_hide_an_offset(sensor):
    after = compared(moved((3, 0, 2), (3, 2, 4), sensor=sensor), sensor)
    assert after.best.names == ()
    assert after.open_effects == (OFFSETS[sensor],)


def test_a_drift_to_one_side_by_chance_is_no_certain_offset(sensor):
    """Scores are for an offset of the tip; trials begin at zero."""
    after = compared(settling(4, sensor), sensor)
    assert after.best.names == ()
    assert after.open_effects == (OFFSETS[sensor],)
    assert [*after.problem.noise.drifts] == [sensor]


def followed(log, sensor, course):
    """Whether the drift of a log is left, and why not, where its readings follow a course of a size."""
    state = compared(off(log, sensor, course), sensor)
    said = [e.reason for e in state.record if e.stage == STAGE and e.decision is Decision.DROPPED]
    return bool(state.problem.noise.drifts), said


def test_what_follows_the_axial_speed_by_little_is_no_drift_either(sensor):
    """Back and forth, in steps that a drift takes for its own."""
    log = sliding()
    speed = log.trials[0].table["speed_mm_s"].to_numpy()
    assert followed(log, sensor, lambda _: 0.5 * speed) == (
        False,
        ["it follows the axial speed, as no drift does"],
    )
    assert followed(log, sensor, lambda own: 2.5 * own) == (True, [])


def test_a_large_drift_of_the_tip_with_nothing_beside_it_is_what_is_missing(sensor):
    """By 5.4 sigma; that of a torque sensor is told beside the diagnosis."""
    large = followed(sliding(), sensor, lambda own: 3.6 * own)
    assert large == (
        (True, []) if sensor == TORQUE else (False, ["it explains the log without any effect"])
    )

"""What the base did before a trial that began late."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, RIG, TIP, TORQUE, log_with, prepared, trial, turns

from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.held_out.cross_validation import information
from diagnosis.fitting.noise_floor import floor_of
from diagnosis.fitting.nuisance import nuisance_of
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.start.late_start import LateStart
from diagnosis.replay.past import schedule_with_past
from diagnosis.replay.replay import predict, shape_of
from diagnosis.replay.resolution import Resolution
from diagnosis.replay.rig_parameters import NOMINAL, Past, RigParameters
from models.drive import DriveKind
from models.modes import InsertedNeedle
from models.needle import Needle

NAME = "trial_01.csv"
START = LateStart(twist_deg=30.0, rate_deg_s=45.0, unused_s=0.5)
WOUND = RigParameters(pasts=(Past(trial=NAME, wound_deg=40.0, turned_deg=10.0),))


def late(angle, start=START):
    return replace(prepared(trial(angle)), late_start=start)


def test_a_trial_from_rest_has_no_past():
    one = late(turns(), None)
    assert schedule_with_past(WOUND, one) is one.schedule


def test_the_base_winds_up_rests_and_turns_into_the_first_sample_at_its_rate():
    one = late(7.0 + 45.0 * 0.01 * np.arange(200))
    found = schedule_with_past(WOUND, one)
    before = found.time_s < 0
    assert found.drive[0] == pytest.approx(7.0 - 30.0 - 10.0 - 40.0)
    resting = (found.time_s >= -3.0) & (found.time_s <= -1.0)
    np.testing.assert_allclose(found.drive[resting], 7.0 - 30.0 - 10.0)
    np.testing.assert_array_equal(found.drive[~before], one.schedule.drive)
    # Over the last step of 10 ms, a cubic from rest changes its rate by less than 8 (40 + 45) deg/s^2.
    last = np.flatnonzero(before)[-1]
    rate = (found.drive[last + 1] - found.drive[last]) / 0.01
    assert rate == pytest.approx(45.0, abs=0.01 * 8 * 85)
    np.testing.assert_allclose(np.diff(found.time_s[before]), 0.01, atol=1e-9)


def test_lengths_and_speed_are_those_of_the_first_sample():
    one = replace(late(turns()), late_start=START, speed_mm_s=np.full(turns().size, 2.0))
    found = schedule_with_past(NOMINAL, one)
    before = found.time_s < 0
    assert set(found.speed_mm_s[before]) == {2.0}
    assert set(found.free_mm[before]) == {60.0}
    assert set(found.inserted_mm[before]) == {90.0}


def test_a_rig_without_a_past_of_its_own_turns_by_the_twist_that_was_read():
    found = schedule_with_past(NOMINAL, late(np.zeros(200)))
    assert found.drive[0] == pytest.approx(-30.0)


def test_the_state_that_a_past_leaves_is_that_of_the_closed_form():
    """The viscous needle after its past, against modes of the same motion (models.modes)."""
    one = late(np.zeros(300), replace(START, rate_deg_s=0.0))
    fine = Resolution(elements=48, step_s=0.0025)
    (found,) = predict(RIG, one, [WOUND], fine)
    held = InsertedNeedle(
        needle=Needle(**dict(RIG.needle)),
        damping_n_mm_s_per_mm=RIG.tissue.damping_n_mm_s_per_mm,
        inserted_mm=90.0,
        free_mm=60.0,
        drive=DriveKind.ANGLE,
    )
    inputs = schedule_with_past(WOUND, one)
    finer_s = np.arange(inputs.time_s[0], inputs.time_s[-1], 0.0025)
    turned = np.radians(np.interp(finer_s, inputs.time_s, inputs.drive) - inputs.drive[0])
    exact = held.respond(finer_s - finer_s[0], turned)
    tip_deg = np.degrees(np.interp(one.time_s, finer_s, exact.tip_rad)) + inputs.drive[0]
    # 48 elements and 2.5 ms: a few thousandths of the 80 deg that were turned, of second order.
    np.testing.assert_allclose(found.tip_angle_deg, tip_deg, atol=0.02)
    assert abs(found.tip_angle_deg[0]) > 5.0


def test_recorded_shapes_begin_with_the_trial():
    run = shape_of(RIG, late(turns(2.0)), WOUND)
    assert run.time_s[0] == pytest.approx(0.0, abs=1e-9)
    assert run.angles_rad.shape[0] == run.time_s.size
    # Wound up by 30 and 40 deg before: what is left of it is there at the first sample.
    assert abs(run.tip_deg[0]) > 3.0


def cut_log(begin):
    """Exact readings of a needle in tissue 1.2 times as viscous, from a row on."""
    rng = np.random.default_rng(3)
    whole = trial(turns())
    held = InsertedNeedle(
        needle=Needle(**dict(RIG.needle)),
        damping_n_mm_s_per_mm=1.2 * RIG.tissue.damping_n_mm_s_per_mm,
        inserted_mm=90.0,
        free_mm=60.0,
    )
    exact = held.respond(whole["time_s"], np.radians(whole["base_angle_deg"]))
    size = whole["time_s"].size
    table = whole.table.assign(
        base_angle_deg=whole["base_angle_deg"] + rng.normal(0, BASE, size),
        tip_angle_deg=np.degrees(exact.tip_rad) + rng.normal(0, TIP, size),
        base_torque_n_mm=exact.base_torque_n_mm + rng.normal(0, TORQUE, size),
    ).iloc[begin:]
    return log_with(replace(whole, table=table.reset_index(drop=True)))


def damping_of(log):
    """The fitted scale of damping, its standard error, and the noise floor."""
    problem = replay_nominal(log).problem
    fit = fit_effects(problem, ("damping_error",))
    spread = np.sqrt(np.linalg.inv(information(fit))[0, 0])
    return fit.x[0], spread, floor_of(fit.by_trial), problem.log.trials[0].late_start


# In the middle of the first turn, at rest after it, and at the second turn.
@pytest.mark.parametrize("begin", [130, 170, 530])
def test_a_log_that_is_cut_says_what_the_whole_log_does(begin):
    log_scale, spread, floor, start = damping_of(cut_log(begin))
    assert start is not None
    assert abs(log_scale - np.log(1.2)) < 3.5 * spread
    assert floor.reached


def test_the_whole_log_begins_at_rest():
    log_scale, spread, floor, start = damping_of(cut_log(0))
    assert start is None
    assert abs(log_scale - np.log(1.2)) < 3.5 * spread
    assert floor.reached


def test_without_a_past_a_log_that_is_cut_is_above_the_floor():
    nominal = replay_nominal(cut_log(130)).problem
    (late,) = nominal.log.trials
    forgotten = replace(nominal.log, trials=(replace(late, late_start=None),))
    blind = replace(nominal, log=forgotten, nuisance=nuisance_of(forgotten))
    assert not floor_of(fit_effects(blind, ("damping_error",)).by_trial).reached

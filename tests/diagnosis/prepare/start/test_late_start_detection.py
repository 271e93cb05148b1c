"""Which trials of a log began late.

The tip's noise is 0.25 deg. A parabola through 25 readings begins with 0.6 of that, so that a twist
above 0.75 deg is one; twists here are 3 deg and more.
"""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import BASE, NOISE, RIG, TIP, TORQUE, log_with, prepared, trial, turns

from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.prepare.start.late_start_detection import (
    begun_as,
    start_rate_deg_s,
    with_late_starts,
    without_unused,
)

FREE_MM, INSERTED_MM = 60.0, 90.0
RESTS = np.zeros(1200)


def log_off_by(tips_deg, torques_n_mm, *, base=None, fades_s=np.inf):
    """Trials that begin off the nominal rig by so much, and their residuals."""
    rng = np.random.default_rng(5)
    time = 0.01 * np.arange(1200)
    fading = np.exp(-time / fades_s)
    tips = [off * fading + rng.normal(0, TIP, time.size) for off in tips_deg]
    torques = [off * fading + rng.normal(0, TORQUE, time.size) for off in torques_n_mm]
    ready = prepared(trial(RESTS if base is None else base))
    trials = tuple(
        replace(
            ready,
            name=f"trial_{i}",
            readings={"tip_angle_deg": tip, "base_torque_n_mm": torque},
        )
        for i, (tip, torque) in enumerate(zip(tips, torques, strict=True))
    )
    return PreparedLog(rig=RIG, trials=trials), {"tip_angle_deg": tips, "base_torque_n_mm": torques}


def late(log, residuals):
    """Indices of the trials that are found to begin late."""
    begun = with_late_starts(log, residuals, NOISE)
    return [i for i, one in enumerate(begun.trials) if one.late_start is not None]


def torque_of(twist_deg):
    """That of a shaft whose twist is half way along the inserted length."""
    return np.radians(twist_deg) * RIG.rigidity_n_mm2 / (FREE_MM + 0.5 * INSERTED_MM)


def test_trials_from_rest_have_no_late_start():
    log, residuals = log_off_by([0.0] * 40, [0.0] * 40)
    assert late(log, residuals) == []
    assert with_late_starts(log, residuals, NOISE).trials == log.trials


def test_what_differs_from_trial_to_trial_is_a_twist_and_what_all_share_is_an_offset():
    # A tip ahead of the base takes a negative torque: both sensors are off.
    offsets = log_off_by([5.0, 5.0, 5.0], [0.2, 0.2, 0.2])
    assert late(*offsets) == []
    assert late(*log_off_by([5.0, 25.0, 5.0], [0.0, -torque_of(-20.0), 0.0])) == [1]


def test_trials_that_begin_twisted_alike_are_told_from_an_offset_by_their_torque():
    assert late(*log_off_by([-30.0, -30.0], [torque_of(30.0)] * 2)) == [0, 1]
    assert late(*log_off_by([-30.0, -30.0], [0.0, 0.0])) == []


def test_another_version_of_a_log_begins_late_in_the_same_trials():
    log, residuals = log_off_by([5.0, 25.0, 5.0], [0.0, -torque_of(-20.0), 0.0])
    marked = begun_as(log, with_late_starts(log, residuals, NOISE))
    assert [one.late_start is not None for one in marked.trials] == [False, True, False]
    assert marked.trials[1].late_start.twist_deg == pytest.approx(-20.0, abs=0.5)
    unused = marked.trials[1].time_s < marked.trials[1].late_start.unused_s
    assert np.isnan(marked.trials[1].readings["tip_angle_deg"][unused]).all()
    assert begun_as(log, log).trials == log.trials


def test_the_twist_is_that_beyond_the_offset_that_all_share():
    log, residuals = log_off_by([5.0, -15.0, 5.0], [0.0, torque_of(20.0), 0.0])
    start = with_late_starts(log, residuals, NOISE).trials[1].late_start
    # The intercept of a parabola through 25 readings: 0.6 of their noise, four of these.
    assert start.twist_deg == pytest.approx(20.0, abs=4 * 0.6 * TIP)


def test_a_torque_that_jumps_as_the_base_moves_is_friction_and_no_late_start():
    moving = 40.0 * 0.01 * np.arange(1200)
    assert late(*log_off_by([0.5, 0.5], [-0.2, -0.3], base=moving)) == []


def test_a_small_twist_at_rest_is_told_by_its_torque():
    assert late(*log_off_by([-0.6, 0.0], [torque_of(5.0), 0.0])) == [0]
    assert late(*log_off_by([0.6, 0.0], [torque_of(5.0), 0.0])) == []


def test_without_a_tip_the_torque_tells():
    log, residuals = log_off_by([0.0, 0.0], [0.0, torque_of(20.0)])
    blind = tuple(
        replace(t, readings={"base_torque_n_mm": t.readings["base_torque_n_mm"]}) for t in log.trials
    )
    begun = with_late_starts(replace(log, trials=blind), residuals, NOISE)
    assert begun.trials[0].late_start is None
    # 0.6 of the torque's noise is 0.2 deg of twist: four of these.
    assert begun.trials[1].late_start.twist_deg == pytest.approx(20.0, abs=0.8)


def test_an_outlier_is_no_late_start():
    log, residuals = log_off_by([0.0], [0.0])
    residuals["tip_angle_deg"][0][1] += 40 * TIP
    assert late(log, residuals) == []


def test_the_first_readings_of_a_late_trial_are_set_aside_in_the_problem_and_in_the_log():
    log, residuals = log_off_by([-30.0], [torque_of(30.0)])
    begun = with_late_starts(log, residuals, NOISE)
    (one,) = begun.trials
    # Ten time constants of the second mode, 10 beta / (kappa w^2): w l tan(w l) = l / f = 1.5 at 3.54.
    assert one.late_start.unused_s == pytest.approx(10 * 0.0172 * 90**2 / (323.6 * 3.54**2), rel=0.01)
    unused = one.time_s < one.late_start.unused_s
    np.testing.assert_array_equal(np.isnan(one.readings["tip_angle_deg"]), unused)
    logged = trial(RESTS)
    read = replace(logged, table=logged.table.assign(tip_angle_deg=1.0))
    (left,) = without_unused(log_with(read), begun).trials
    np.testing.assert_array_equal(np.isnan(left["tip_angle_deg"]), unused)
    assert np.isfinite(left["base_angle_deg"]).all()
    assert np.isfinite(read["tip_angle_deg"]).all()


def test_the_rate_of_the_base_is_that_of_its_first_tenth_of_a_second():
    read = turns() + np.random.default_rng(7).normal(0, BASE, turns().size)
    # A ramp of 90 deg in 0.6 s. A line through ten readings: BASE / (0.0287 s sqrt(10)), four of these.
    sigma_deg_s = BASE / (0.0287 * np.sqrt(10))
    assert start_rate_deg_s(prepared(trial(read[100:]))) == pytest.approx(150.0, abs=4 * sigma_deg_s)
    assert start_rate_deg_s(prepared(trial(read))) == pytest.approx(0.0, abs=4 * sigma_deg_s)


@pytest.mark.parametrize(
    ("first_deg", "rate_deg_s", "under_way"),
    [(-20.0, 50.0, True), (0.0, 50.0, False), (-20.0, 0.0, False)],
)
def test_a_turn_that_begins_off_zero_was_under_way_before_however_untwisted(
    first_deg, rate_deg_s, under_way
):
    """One that begins at zero may begin there, and a base that rests off zero is not zeroed."""
    base = first_deg + rate_deg_s * 0.01 * np.arange(1200)
    assert late(*log_off_by([0.0, 0.0], [0.0, 0.0], base=base)) == ([0, 1] if under_way else [])


def test_a_turn_that_starts_from_rest_off_zero_with_the_recording_was_not_under_way():
    """theta = a t^2 / 2 from rest: a line through the first tenth of a second rises by 50 deg/s."""
    base = -20.0 + 500.0 * (0.01 * np.arange(1200)) ** 2
    assert late(*log_off_by([0.0, 0.0], [0.0, 0.0], base=base)) == []

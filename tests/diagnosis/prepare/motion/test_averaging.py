"""Logs of many samples a second, averaged."""

import numpy as np
import pytest
from diagnosis_fixtures import BASE, RIG, TIP, joined, log_with, trial, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.motion.averaging import averaged

STEP_S = 0.001


def fast(seconds=12.0, step=STEP_S):
    """A log of 1000 samples a second; the tip reads a line in time, with noise."""
    rng = np.random.default_rng(1)
    one = trial(turns(seconds, step), step=step)
    read = 3.0 * one["time_s"] + rng.normal(0, TIP, len(one.table))
    return log_with(Trial(name=one.name, table=one.table.assign(tip_angle_deg=read)))


def test_ten_samples_become_one_with_a_third_of_the_noise():
    log = averaged(fast())
    (one,) = log.trials
    assert np.median(np.diff(one["time_s"])) == pytest.approx(0.01)
    noise = (one["tip_angle_deg"] - 3.0 * one["time_s"])[1:-2]
    # 1200 means: their scatter is known to 2 %.
    assert np.std(noise) == pytest.approx(TIP / np.sqrt(10), rel=0.07)
    assert log.rig.sensors.tip_angle_noise_deg == pytest.approx(TIP / np.sqrt(10))
    assert "1000 samples a second" in log.warnings[-1]


@pytest.mark.parametrize("step", [0.05, 0.01, 0.002])
def test_trials_at_quite_different_rates_stay_as_they_are(step):
    """A window that suits the fast ones has no or few samples of the slow one."""
    log = joined(fast(), fast(), fast(), fast(step=step))
    assert averaged(log) is log


def test_rates_that_differ_by_little_are_averaged():
    log = averaged(joined(fast(), fast(), fast(step=0.0013)))
    assert log.means_of == 10
    assert [np.isfinite(one["tip_angle_deg"]).mean() > 0.95 for one in log.trials] == [True] * 3


def test_the_motion_begins_and_ends_where_it_did():
    read, one = fast().trials[0], averaged(fast()).trials[0]
    for row in (0, -1):
        assert one["time_s"][row] == read["time_s"][row]
        assert one["base_angle_deg"][row] == read["base_angle_deg"][row]
        assert np.isnan(one["tip_angle_deg"][row])
    assert np.isnan(one["tip_angle_deg"][-2])  # of a window that may be a part of one
    there = np.interp(one["time_s"], read["time_s"], read["base_angle_deg"])
    # A corner of 150 deg/s is cut by an eighth of what turns in a window.
    assert np.abs(one["base_angle_deg"] - there).max() <= 150 * 0.01 / 8 + BASE


def test_the_rows_of_the_file_are_kept():
    rows = averaged(fast()).trials[0].file_rows
    np.testing.assert_array_equal(rows.stamps_s, fast().trials[0]["time_s"])
    np.testing.assert_array_equal(rows.taken_s, rows.stamps_s)


def test_readings_in_coarse_steps_stay_on_their_steps():
    """Means of them would lie between, and look like readings in steps of a tenth."""
    log, step = fast(), 0.25
    (one,) = log.trials
    coarse = one.table.assign(base_angle_deg=step * np.round(one["base_angle_deg"] / step))
    (found,) = averaged(log_with(Trial(name=one.name, table=coarse))).trials
    steps = found["base_angle_deg"] / step
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-9)
    off = found["base_angle_deg"] - averaged(log).trials[0]["base_angle_deg"]
    assert np.abs(off).max() < 1.5 * 150 * 0.01 + step
    assert np.abs(np.mean(off)) < 0.5 * step


def test_missing_readings_do_not_move_a_mean():
    log = fast()
    table = log.trials[0].table.copy()
    table.loc[5003:5006, "tip_angle_deg"] = np.nan  # of a window from 5000 to 5009
    table.loc[6000:6008, "tip_angle_deg"] = np.nan
    (one,) = averaged(log_with(Trial(name="trial_01.csv", table=table))).trials
    beside = {round(t, 4): v for t, v in zip(one["time_s"], one["tip_angle_deg"], strict=True)}
    assert beside[5.0045] == pytest.approx(15.0, abs=4 * TIP / np.sqrt(6))
    assert np.isnan(beside[6.0045])


@pytest.mark.parametrize("step", [0.01, 0.005])
def test_a_log_of_usual_rate_is_left_alone(step):
    log = fast(step=step)
    assert averaged(log) is log
    assert log.rig is RIG

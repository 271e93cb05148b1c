"""Angles that start again where a turn ends."""

import re

import numpy as np
import pytest
from analytic_log import BASE, TIP, change_trial, refusal

from diagnosis.log.checks.angle_wraps import wraps
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog

SENSORS = {"base_angle_deg": BASE, "tip_angle_deg": TIP}


def far(t):
    """The same trial, with turns of 360 and -120 deg."""
    return t.assign(**{name: 4 * t[name] for name in (*SENSORS, "base_torque_n_mm")})


def wrapped(column, period, low):
    return lambda t: t.assign(**{column: (t[column] - low) % period + low})


@pytest.mark.parametrize("column", SENSORS)
@pytest.mark.parametrize(("period", "low"), [(360, -180), (360, 0), (180, -90), (180, 0)])
def test_a_wrap_is_named_with_its_period_and_the_fix(log, column, period, low):
    change_trial(log, lambda t: wrapped(column, period, low)(far(t)))
    said = refusal(log)
    assert re.search(rf"turns\.csv: {column} wraps: it jumps by {period} deg.*lines? \d+", said)
    assert f"numpy.unwrap(values, period={period})" in said


def test_the_fix_makes_it_good(log):
    change_trial(log, lambda t: wrapped("tip_angle_deg", 360, -180)(far(t)))
    with pytest.raises(UnusableLog):
        read_rig_log(log)
    change_trial(log, lambda t: t.assign(tip_angle_deg=np.unwrap(t["tip_angle_deg"], period=360)))
    assert read_rig_log(log).warnings == ()


def test_the_rows_after_each_wrap_are_told():
    angle = np.linspace(0, 800, 401)  # 2 deg a sample: beyond 180 at 91, beyond 540 at 271
    rows = wraps(0.01 * np.arange(401), (angle + 180) % 360 - 180 + 1e-9, 360.0)
    np.testing.assert_array_equal(np.flatnonzero(rows), [90, 270])


def test_a_hold_at_the_end_of_the_range_flickers():
    rng = np.random.default_rng(1)
    held = 180 + rng.normal(0, TIP, 400)
    assert wraps(0.01 * np.arange(400), (held + 180) % 360 - 180, 360.0).any()


SLOWLY = np.linspace(140.0, 180.0, 800)
NO_WRAPS = {
    "steps of half a turn": np.where(np.arange(800) // 100 % 2, 90.0, -90.0),
    "steps of a whole turn": np.where(np.arange(800) // 100 % 2, 360.0, 0.0),
    "slips of half a turn": np.arange(800) // 100 * 180.0 + 0.02 * (np.arange(800) % 100),
    "spikes": np.where(np.arange(800) % 97 == 50, 180.0, 0.0),
    "drop-outs at half a turn": np.where(np.isin(np.arange(800) % 97, [50, 51]), 0.0, SLOWLY),
    "several turns": np.linspace(0, 3000, 800),
}


@pytest.mark.parametrize("what", NO_WRAPS)
@pytest.mark.parametrize("period", [360.0, 180.0])
def test_steps_slips_spikes_and_turns_are_no_wraps(what, period):
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0, TIP, 800)
        assert not wraps(0.01 * np.arange(800), NO_WRAPS[what] + noise, period).any()


def test_a_sensor_that_drops_out_again_and_again_near_half_a_turn_is_no_wrap():
    """It reads zero exactly, from wherever the angle was."""
    for seed in range(20):
        read = SLOWLY + np.random.default_rng(seed).normal(0, TIP, 800)
        dropped = np.where(np.isin(np.arange(800) % 97, [48, 50, 52, 53]), 0.0, read)
        assert not wraps(0.01 * np.arange(800), dropped, 180.0).any()


def test_what_moved_across_a_pause_is_no_wrap(log):
    """From -90 to 270 deg within it."""
    change_trial(
        log,
        lambda t: far(t).assign(base_angle_deg=4 * t["base_angle_deg"] - 90).drop(index=range(101, 200)),
    )
    assert any("time_s jumps" in warning for warning in read_rig_log(log).warnings)

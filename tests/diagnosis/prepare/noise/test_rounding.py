"""Readings in coarse steps."""

import numpy as np
import pytest
from diagnosis_fixtures import BASE, RIG, TIP, log_with, trial, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.noise.rounding import rounded_noise, steps_of, without_repeats
from diagnosis.prepare.prepare import prepare

STEP = 5 * TIP


def rounded(*, step=STEP, base_step=0.0, seed=1):
    """A trial whose tip follows the base, in steps, and whose base may be in steps too."""
    rng = np.random.default_rng(seed)
    angle = turns() + rng.normal(0, BASE, turns().size)
    base = np.round(angle / base_step) * base_step if base_step else angle
    tip = turns() + 0.3 * STEP + rng.normal(0, TIP, angle.size)
    one = trial(base)
    return Trial(name=one.name, table=one.table.assign(tip_angle_deg=np.round(tip / step) * step))


def test_coarse_steps_are_found_and_fine_ones_are_not():
    assert steps_of(RIG, [rounded()]) == {"tip_angle_deg": pytest.approx(STEP)}
    assert steps_of(RIG, [rounded(step=TIP)]) == {}
    assert steps_of(RIG, [rounded(base_step=0.32)])["base_angle_deg"] == pytest.approx(0.32)


def test_a_motion_without_noise_is_no_coarse_one():
    """Even steps of a ramp, 1.5 deg each, and rests."""
    assert steps_of(RIG, [trial(turns())]) == {}


def test_rounding_adds_its_noise():
    noise = rounded_noise(RIG, {"tip_angle_deg": STEP})["tip_angle_deg"]
    assert noise == pytest.approx(np.hypot(TIP, STEP / np.sqrt(12)))


def test_of_readings_that_stand_still_one_in_half_a_second_counts():
    one = rounded()
    left = np.isfinite(without_repeats(one, RIG, steps_of(RIG, [one]))["tip_angle_deg"])
    time = one["time_s"]
    held, turning = (time > 2.5) & (time < 4.5), (time > 1.1) & (time < 1.5)
    assert 3 <= left[held].sum() <= 5
    assert left[turning].all()


def test_steps_that_noise_shakes_readings_across_all_count():
    one = rounded(step=2.5 * TIP)
    assert np.isfinite(without_repeats(one, RIG, steps_of(RIG, [one]))["tip_angle_deg"]).all()


def test_a_coarse_base_that_stands_still_makes_all_readings_count_once():
    one = rounded(step=0.001, base_step=0.32)
    log, sigma_deg = prepare(log_with(one))
    assert sigma_deg == pytest.approx(np.hypot(BASE, 0.32 / np.sqrt(12)))
    left = np.isfinite(log.trials[0].readings["tip_angle_deg"])
    time = log.trials[0].time_s
    assert left[(time > 2.5) & (time < 4.5)].sum() <= 5
    # Of a base in steps no more than half of one is missed, and at corners what smoothing asks for.
    assert np.abs(log.trials[0].base_motion_deg - turns()).max() < 3 * sigma_deg + 0.15

"""Offsets of clocks that are known."""

import numpy as np
import pytest
from analytic_log import TURNS

from diagnosis.criteria.lab_files import CLOCK_LEAST_S
from diagnosis.lab_files.guesses.clock_offset import clock_offset

TIME, BASE_DEG = TURNS["time_s"].to_numpy(), TURNS["base_angle_deg"].to_numpy()
TORQUE = TURNS["base_torque_n_mm"].to_numpy()


@pytest.mark.parametrize("late_s", [0.0, 0.35, -0.8, 2.0])
@pytest.mark.parametrize("sign", [1, -1])
def test_a_late_torque_is_late_by_its_offset(late_s, sign):
    """What the tool itself takes for no offset is the bound; the found ones are 0.02 s off at most."""
    found = clock_offset(TIME + late_s, sign * TORQUE, TIME, BASE_DEG, torque=True)
    assert found.late_s == pytest.approx(late_s, abs=CLOCK_LEAST_S)
    assert found.uncertainty_s < 0.1


def test_an_offset_changes_the_lag_by_as_much():
    none = clock_offset(TIME, TORQUE, TIME, BASE_DEG, torque=True)
    late = clock_offset(TIME + 0.35, TORQUE, TIME, BASE_DEG, torque=True)
    assert late.late_s - none.late_s == pytest.approx(0.35, abs=0.01)  # a sample


def test_clocks_of_different_years_are_laid_on_top_of_each_other():
    found = clock_offset(TIME + 1.7e9, TORQUE, TIME, BASE_DEG, torque=True)
    assert found.late_s - 1.7e9 == pytest.approx(0, abs=CLOCK_LEAST_S)


def test_a_slower_sampling_does_not_shift():
    found = clock_offset(TIME[::5] + 0.35, TORQUE[::5], TIME, BASE_DEG, torque=True)
    assert found.late_s == pytest.approx(0.35, abs=CLOCK_LEAST_S)


def test_an_offset_beyond_a_quarter_of_the_record_is_not_made_up():
    found = clock_offset(TIME + 4, TORQUE, TIME, BASE_DEG, torque=True)
    assert found.late_s is None  # 2 s are looked at, of 8 in common


def test_noise_and_short_records_have_no_offset():
    noise = np.random.default_rng(1).normal(size=TIME.size)
    assert clock_offset(TIME, noise, TIME, BASE_DEG, torque=True).late_s is None
    assert clock_offset(TIME[:3], TORQUE[:3], TIME, BASE_DEG, torque=True).late_s is None

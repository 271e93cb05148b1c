"""A trial as the rig logged it."""

import numpy as np
import pytest
from analytic_log import TURNS, change_trial

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import COLUMNS, REQUIRED, SENSORS, Trial, sampled_at


def test_sensors_may_be_absent_or_empty(log):
    change_trial(log, lambda t: t.drop(columns="tip_angle_deg").assign(base_torque_n_mm=np.nan))
    trial = read_rig_log(log).trials[0]
    assert not trial.has("tip_angle_deg")
    assert not trial.has("base_torque_n_mm")


def test_a_column_is_an_array_of_its_samples():
    trial = Trial(name="turns.csv", table=TURNS)
    assert trial.has("tip_angle_deg")
    np.testing.assert_array_equal(trial["tip_angle_deg"], TURNS["tip_angle_deg"])


@pytest.mark.parametrize(
    ("step_s", "same"), [(0.01, True), (0.0101, True), (0.0104, False), (0.005, False)]
)
def test_samples_are_so_far_apart_to_two_per_cent_in_the_median(step_s, same):
    time_s = 0.01 * np.arange(100)
    time_s[50:] += 3.0  # a pause
    assert sampled_at(time_s, step_s) is same


def test_the_columns_are_those_of_the_format():
    assert set(TURNS) < set(COLUMNS)
    assert set(REQUIRED).isdisjoint(SENSORS)
    assert set(REQUIRED) | set(SENSORS) | {"tip_torque_n_mm"} == set(COLUMNS)

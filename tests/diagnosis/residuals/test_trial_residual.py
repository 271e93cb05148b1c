"""Residuals of a trial, sample by sample and at even steps."""

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, TORQUE, log_with, trial, turns

from diagnosis.log.trial import Trial
from diagnosis.replay.prediction import Prediction
from diagnosis.residuals.trial_residual import (
    TrialResidual,
    by_sensor,
    on_even_steps,
    sample_s,
    trial_residuals,
)

TORQUE_NAME, TIP_NAME = "base_torque_n_mm", "tip_angle_deg"


def residual_of(time, left):
    """The residual of a tip at some times."""
    own = trial(np.zeros(time.size))
    return TrialResidual(
        trial=Trial(name="one", table=own.table.assign(time_s=time)), left={TIP_NAME: left}
    )


def test_a_residual_is_measured_minus_predicted_in_units_of_the_noise():
    motion = trial(turns(2.0))
    measured = motion.table.assign(base_torque_n_mm=3 * TORQUE, tip_angle_deg=np.nan)
    nothing = Prediction(tip_angle_deg=np.zeros(200), base_torque_n_mm=np.full(200, TORQUE))
    log = log_with(Trial(name="torque alone", table=measured))
    (found,) = trial_residuals(log, [nothing], NOISE)
    assert set(found.left) == {TORQUE_NAME}
    np.testing.assert_allclose(found.left[TORQUE_NAME], 2.0)
    np.testing.assert_allclose(found.squares, 4.0)
    assert by_sensor([found]) == {TORQUE_NAME: [found]}


def test_the_mean_square_is_over_the_sensors_that_read_something():
    left = {TIP_NAME: np.array([1.0, np.nan, np.nan]), TORQUE_NAME: np.array([3.0, 2.0, np.nan])}
    found = TrialResidual(trial=trial(np.zeros(3)), left=left).squares
    np.testing.assert_array_equal(found, [5.0, 4.0, np.nan])


def test_even_samples_stay_what_they_are():
    time = 0.01 * np.arange(50)
    one = residual_of(time, np.arange(50.0))
    assert sample_s([one]) == pytest.approx(0.01)
    np.testing.assert_array_equal(on_even_steps(one, TIP_NAME, 0.01), np.arange(50.0))


def test_jitter_moves_samples_to_the_nearest_step_and_what_is_missing_stays_missing():
    time = np.array([0.0, 0.012, 0.019, 0.05, 0.061])
    found = on_even_steps(residual_of(time, np.array([1.0, 2, 3, np.nan, 5])), TIP_NAME, 0.01)
    np.testing.assert_array_equal(found, [1, 2, 3, np.nan, np.nan, np.nan, 5])


def test_a_pause_of_an_hour_takes_no_more_room_than_the_longest_lag():
    time = np.array([0.0, 0.1, 3600.0, 3600.1])
    assert on_even_steps(residual_of(time, np.ones(4)), TIP_NAME, 0.1).size == 103

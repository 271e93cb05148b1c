"""Predicted readings of both sensors, and what is taken as read."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, log_of, prepared, problem_of, trial, turns

from diagnosis.prepare.low_band import low_passed
from diagnosis.prepare.start.late_start import LateStart
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.sensing.reading_errors import SmoothedReading


@pytest.mark.parametrize("sensor", ["tip_angle_deg", "base_torque_n_mm"])
def test_what_a_fast_clock_shows_past_the_end_of_a_trial_is_taken_as_read(sensor):
    """A clock of 2 % is past the end of 6 s from 5.88 s on; nobody knows the motion there."""
    (one,) = problem_of(log_of(RigParameters(), seconds=6.0)).log.trials
    ratio = {"tip_angle_deg": "tip_clock_ratio", "base_torque_n_mm": "torque_clock_ratio"}[sensor]
    (found,) = predict(RIG, one, [RigParameters(**{ratio: 1.02})])
    past = one.time_s * 1.02 > one.time_s[-1]
    assert 5 < past.sum() < 20
    read = one.readings[sensor]
    np.testing.assert_array_equal(found[sensor][past], read[past])
    assert not np.any(found[sensor][~past] == read[~past])
    (exact,) = predict(RIG, one, [RigParameters()])
    assert not np.any(exact[sensor] == read)


@pytest.mark.parametrize(
    ("filtered", "memory_s"),
    [
        ({"torque_low_pass_s": 0.05}, 8 * 0.05),
        ({"torque_butterworth_s": 0.05}, 8 * 0.05 * np.sqrt(2)),
        ({"torque_average_s": 0.3}, 0.3),
        ({"torque_low_pass_s": 0.5}, 0.25 * 6.0),  # a quarter of the trial at most
        ({}, 0.0),
    ],
)
def test_what_a_filter_shows_of_before_a_late_start_is_taken_as_read(filtered, memory_s):
    (one,) = problem_of(log_of(RigParameters(), seconds=6.0)).log.trials
    late = replace(one, late_start=LateStart(twist_deg=5.0, rate_deg_s=0.0, unused_s=0.1))
    (found,) = predict(RIG, late, [RigParameters(**filtered)])
    as_read = found["base_torque_n_mm"] == one.readings["base_torque_n_mm"]
    np.testing.assert_array_equal(as_read, one.time_s < memory_s - 1e-9)
    assert not np.any(found["tip_angle_deg"] == one.readings["tip_angle_deg"])
    (zeroed,) = predict(RIG, one, [RigParameters(**filtered)])
    assert not np.any(zeroed["base_torque_n_mm"] == one.readings["base_torque_n_mm"])


def test_predictions_of_smoothed_readings_are_those_in_their_low_band():
    ready, tip = prepared(trial(turns())), "tip_angle_deg"
    known = SmoothedReading(sensor=tip, second_coefficient=0.2, fourth_coefficient=1.0)
    rigs = [NOMINAL, RigParameters(smoothed=(known,))]
    read = predict(RIG, ready, [NOMINAL])[0]
    low = predict(RIG, replace(ready, smoothed_above_hz={tip: 5.0}), rigs)
    for prediction, coefficients in zip(low, [(0.0, 0.0), (0.2, 1.0)], strict=True):
        np.testing.assert_array_equal(
            prediction[tip], low_passed(ready.time_s, read[tip], 5.0, *coefficients)
        )
        np.testing.assert_array_equal(prediction["base_torque_n_mm"], read["base_torque_n_mm"])


def test_some_rows_of_a_prediction_are_those_of_both_sensors():
    prediction = Prediction(tip_angle_deg=np.arange(4.0), base_torque_n_mm=-np.arange(4.0))
    rows = prediction.rows(np.array([True, False, True, False]))
    np.testing.assert_array_equal(rows.tip_angle_deg, [0, 2])
    np.testing.assert_array_equal(rows["base_torque_n_mm"], [0, -2])

"""The drift of the torque sensor that a prediction leaves."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.prepare.noise.sensor_noise import TORQUE
from diagnosis.replay.drift import (
    drift_range_sigma,
    drifts_alike,
    least_start,
    torque_drift_sigma,
    with_drift,
)
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL


@pytest.fixture(scope="module")
def drifting():
    """A log whose torque drifts by a line of three sigma, its size, and what the rig predicts."""
    problem = problem_of(log_of(NOMINAL, seconds=12.0))
    sigma = problem.noise["base_torque_n_mm"]
    (one,) = problem.log.trials
    line = 3.0 * one.time_s / one.time_s[-1]
    off = {**one.readings, "base_torque_n_mm": one.readings["base_torque_n_mm"] + sigma * line}
    log = replace(problem.log, trials=(replace(one, readings=off),))
    return replace(problem, log=log), line, replay(problem.log)


def test_without_leave_there_is_no_drift(drifting):
    problem, _, predictions = drifting
    assert drift_range_sigma(problem.log, problem.noise, predictions) == 0.0
    (same,) = with_drift(problem.log, problem.noise, predictions)
    np.testing.assert_array_equal(same.base_torque_n_mm, predictions[0].base_torque_n_mm)


def test_a_line_is_found_and_belongs_to_what_the_sensor_reads(drifting):
    """Of some hundred samples in each of its shapes, noise leaves 0.1 to 0.3 sigma."""
    problem, line, predictions = drifting
    log, noise = problem.log, replace(problem.noise, torque_drift_n_mm=2.0 * problem.noise[TORQUE])
    (trial,) = log.trials
    found = torque_drift_sigma(trial, predictions[0], noise)
    assert np.sqrt(np.mean((found - line) ** 2)) < 0.4
    assert drift_range_sigma(log, noise, predictions) == pytest.approx(3.0, abs=1.0)
    (shown,) = with_drift(log, noise, predictions)
    moved = shown.base_torque_n_mm - predictions[0].base_torque_n_mm
    np.testing.assert_allclose(moved, problem.noise["base_torque_n_mm"] * found)
    np.testing.assert_array_equal(shown.tip_angle_deg, predictions[0].tip_angle_deg)


@pytest.mark.parametrize(
    ("shapes", "alike"),
    [
        (("line", "line"), True),
        (("line", "opposite"), False),
        (("line", "half"), False),
        (("wave", "wave"), False),
        (("line",), False),
    ],
)
def test_one_line_in_every_trial_is_a_law_and_anything_else_is_none(shapes, alike, drifting):
    problem, line, (prediction,) = drifting
    (one,) = problem.log.trials
    course = {"line": line, "opposite": -line, "half": 0.5 * line, "wave": 3.0 * np.sin(1.5 * line)}
    plain = one.readings[TORQUE] - problem.noise[TORQUE] * line
    trials = tuple(
        replace(one, readings={**one.readings, TORQUE: plain + 3.0 * problem.noise[TORQUE] * course[s]})
        for s in shapes
    )
    noise = replace(problem.noise, torque_drift_n_mm=2.0 * problem.noise[TORQUE])
    log = replace(problem.log, trials=trials)
    assert drifts_alike(log, noise, [prediction] * len(trials)) is alike


def test_a_drift_from_zero_starts_there_and_one_beside_an_offset_does_not(drifting):
    problem, _, predictions = drifting
    noise = replace(problem.noise, torque_drift_n_mm=problem.noise[TORQUE])
    (one,) = problem.log.trials
    raised = {**one.readings, TORQUE: one.readings[TORQUE] + 3.0 * noise[TORQUE]}
    offset = replace(problem.log, trials=(replace(one, readings=raised),))
    assert least_start(problem.log, noise, predictions) < 3.0 < least_start(offset, noise, predictions)
    assert least_start(offset, problem.noise, predictions) == 0.0  # no drift is allowed for

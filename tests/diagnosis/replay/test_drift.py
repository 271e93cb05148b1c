"""The drift of a sensor that a prediction leaves."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.drift import AllowedDrift
from diagnosis.replay.drift import (
    drift_in_a_second_sigma,
    drift_range_sigma,
    drift_ranges_sigma,
    drift_sigma,
    drifts_alike,
    drifts_by_one_course,
    means_sigma,
    starts,
    with_drift,
)
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL


@pytest.fixture(scope="module", params=SENSORS)
def sensor(request):
    """That drifts."""
    return request.param


@pytest.fixture(scope="module")
def drifting(sensor):
    """A log whose sensor drifts by a line of three sigma, its size, and what the rig predicts."""
    problem = problem_of(log_of(NOMINAL, seconds=12.0))
    sigma = problem.noise[sensor]
    (one,) = problem.log.trials
    line = 3.0 * one.time_s / one.time_s[-1]
    off = {**one.readings, sensor: one.readings[sensor] + sigma * line}
    log = replace(problem.log, trials=(replace(one, readings=off),))
    return replace(problem, log=log), line, replay(problem.log)


def allowing(noise, sensor, sigmas):
    """The noise with a drift of the sensor, of so many sigma."""
    return noise.with_drift(sensor, AllowedDrift(size=sigmas * noise[sensor]))


def test_without_leave_there_is_no_drift(drifting, sensor):
    problem, _, predictions = drifting
    assert drift_range_sigma(problem.log, sensor, problem.noise, predictions) == 0.0
    (same,) = with_drift(problem.log, problem.noise, predictions)
    for one in SENSORS:
        np.testing.assert_array_equal(same[one], predictions[0][one])


def test_a_line_is_found_and_belongs_to_what_the_sensor_reads(drifting, sensor):
    """Of some hundred samples in each of its shapes, noise leaves 0.1 to 0.3 sigma."""
    problem, line, predictions = drifting
    log, noise = problem.log, allowing(problem.noise, sensor, 2.0)
    (trial,) = log.trials
    found = drift_sigma(trial, sensor, predictions[0], noise)
    assert np.sqrt(np.mean((found - line) ** 2)) < 0.4
    assert drift_range_sigma(log, sensor, noise, predictions) == pytest.approx(3.0, abs=1.0)
    (other,) = {*SENSORS} - {sensor}
    assert drift_ranges_sigma(log, noise, predictions) == {
        sensor: drift_range_sigma(log, sensor, noise, predictions),
        other: 0.0,
    }
    (shown,) = with_drift(log, noise, predictions)
    moved = shown[sensor] - predictions[0][sensor]
    np.testing.assert_allclose(moved, problem.noise[sensor] * found, atol=1e-12)
    np.testing.assert_array_equal(shown[other], predictions[0][other])


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
def test_one_line_in_every_trial_is_a_law_and_anything_else_is_none(shapes, alike, drifting, sensor):
    problem, line, (prediction,) = drifting
    (one,) = problem.log.trials
    course = {"line": line, "opposite": -line, "half": 0.5 * line, "wave": 3.0 * np.sin(1.5 * line)}
    plain = one.readings[sensor] - problem.noise[sensor] * line
    trials = tuple(
        replace(one, readings={**one.readings, sensor: plain + 3.0 * problem.noise[sensor] * course[s]})
        for s in shapes
    )
    noise = allowing(problem.noise, sensor, 2.0)
    log = replace(problem.log, trials=trials)
    assert drifts_alike(log, sensor, noise, [prediction] * len(trials)) is alike


@pytest.mark.parametrize(
    ("shapes", "one"),
    [
        (("line", "line"), True),
        (("wave", "wave", "wave"), True),
        (("wave", "raised"), True),
        (("wave", "opposite"), False),
        (("wave", "half"), False),
        (("wave", "line"), False),
        (("wave",), False),
    ],
)
def test_one_course_in_every_trial_is_a_law_wherever_it_begins(shapes, one, drifting, sensor):
    problem, line, (prediction,) = drifting
    (trial,) = problem.log.trials
    wave = 3.0 * np.sin(1.5 * line)
    course = {"line": line, "wave": wave, "raised": wave + 1.0, "opposite": -wave, "half": 0.5 * wave}
    plain = trial.readings[sensor] - problem.noise[sensor] * line
    trials = tuple(
        replace(
            trial, readings={**trial.readings, sensor: plain + 3.0 * problem.noise[sensor] * course[s]}
        )
        for s in shapes
    )
    log, noise = replace(problem.log, trials=trials), allowing(problem.noise, sensor, 2.0)
    assert drifts_by_one_course(log, sensor, noise, [prediction] * len(trials)) is one


def test_a_drift_from_zero_starts_there_and_one_beside_an_offset_does_not(drifting, sensor):
    problem, _, predictions = drifting
    noise = allowing(problem.noise, sensor, 1.0)
    (one,) = problem.log.trials
    raised = {**one.readings, sensor: one.readings[sensor] + 3.0 * noise[sensor]}
    offset = replace(problem.log, trials=(replace(one, readings=raised),))
    (zeroed,) = starts(problem.log, sensor, noise, predictions)
    (raised,) = starts(offset, sensor, noise, predictions)
    assert abs(zeroed) < 3.0 < raised
    assert not starts(offset, sensor, problem.noise, predictions).size  # no drift is allowed for
    (low,), (high,) = (means_sigma(log, sensor, noise, predictions) for log in (problem.log, offset))
    assert high - low == pytest.approx(3.0, abs=0.1)


def test_what_it_moves_by_in_a_second_is_found(drifting, sensor):
    """Of its line, 3 sigma in the whole trial, and of a sine that is faster."""
    problem, line, predictions = drifting
    noise = allowing(problem.noise, sensor, 2.0)
    (trial,) = problem.log.trials
    seconds = float(np.ptp(trial.time_s))
    found = drift_in_a_second_sigma(problem.log, sensor, noise, predictions)
    assert found == pytest.approx(np.ptp(line) / seconds, abs=0.5)
    wave = 4.0 * np.sin(2.0 * np.pi * trial.time_s / 2.0) * noise[sensor]  # there and back in 2 s
    (one,) = predictions
    waving = [replace(one, **{sensor: one[sensor] - wave})]
    assert drift_in_a_second_sigma(problem.log, sensor, noise, waving) == pytest.approx(8.0, abs=1.5)

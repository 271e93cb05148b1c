"""Times that are not exact, as noise of what is predicted."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, log_with, trial

from diagnosis.prepare.prepare import prepare
from diagnosis.replay.accuracy.uncertain_times import (
    errors_by_times,
    warnings_of_times,
    weighted_by_errors,
)
from diagnosis.replay.replay import predict, replay
from diagnosis.replay.rig_parameters import NOMINAL

TORQUE, TIP = "base_torque_n_mm", "tip_angle_deg"
STEP_S, DENSE_S, END_S = 0.05, 0.005, 20.0
SCATTER_S = 0.005
EXAMPLES = 8


def motion(time_s):
    """Up to 150 deg/s, and at rest from 12 s."""
    return 60.0 * (1.0 - np.cos(2.5 * np.minimum(time_s, 4.8 * np.pi / 2.5)))


def late_times(seed, samples):
    """Times of samples that are off, each by itself."""
    return SCATTER_S * np.random.default_rng(seed).normal(size=samples)


def log_read_at(late_s):
    """A log whose samples are stamped evenly, and were taken late by this, from a dense replay."""
    dense_s = np.arange(0, END_S, DENSE_S)
    seen = predict(RIG, prepare(log_with(trial(motion(dense_s), step=DENSE_S)))[0].trials[0], [NOMINAL])
    stamps_s = np.arange(0, END_S, STEP_S)
    at = stamps_s + late_s
    rare = trial(motion(at), step=STEP_S)
    table = rare.table.assign(**{s: np.interp(at, dense_s, seen[0][s]) for s in (TORQUE, TIP)})
    return prepare(log_with(replace(rare, table=table)))[0]


def uncertain(log, errors_s):
    trials = tuple(replace(own, time_errors_s=errors_s) for own in log.trials)
    return replace(log, trials=trials)


@pytest.fixture(scope="module")
def late():
    samples = np.arange(0, END_S, STEP_S).size
    return np.stack([late_times(seed, samples) for seed in range(1 + EXAMPLES)])


@pytest.fixture(scope="module")
def read_late(late):
    """The log, and the errors that its times may have."""
    log = uncertain(log_read_at(late[0]), late[1:])
    return log, replay(log), errors_by_times(log, replay(log))


def test_the_error_that_is_told_is_that_of_the_prediction(read_late):
    """Examples of the same scatter, from a dense replay of the true times; each error is its own.

    The whole error counts as white: no mean over 25 samples may be larger, so it is no smaller than
    what the prediction is off by, and no larger than five times that.
    """
    log, predictions, errors = read_late
    own = log.trials[0]
    for sensor in (TORQUE, TIP):
        moving = (own.time_s > 1) & (own.time_s < 11)
        off = (own.readings[sensor] - predictions[0][sensor])[moving]
        told = errors.whole[0][sensor][moving]
        assert 0.8 < np.sqrt(np.mean(told**2) / np.mean(off**2)) < 5.0


def test_the_fast_part_is_what_differences_show(read_late):
    """Fourth differences of the error itself, as multiples that leave white noise its size."""
    log, predictions, errors = read_late
    own = log.trials[0]
    moving = (own.time_s > 1) & (own.time_s < 11)
    off = np.diff(own.readings[TORQUE] - predictions[0][TORQUE], 4) / np.sqrt(70)
    fast = errors.fast[0][TORQUE][2:-2]
    ratio = np.mean(fast[moving[2:-2]] ** 2) / np.mean(off[moving[2:-2]] ** 2)
    assert 1 / 1.5 < np.sqrt(ratio) < 1.5


def test_at_rest_no_time_matters(read_late):
    log, _, errors = read_late
    still = log.trials[0].time_s > 18
    assert errors.whole[0][TIP][still].max() < 1e-2 * errors.whole[0][TIP].max()


def test_readings_count_for_less_by_their_error(read_late):
    log, _, errors = read_late
    own = weighted_by_errors(log, errors.whole, NOISE).trials[0]
    expected = 1 / np.sqrt(1 + (errors.whole[0][TORQUE] / NOISE[TORQUE]) ** 2)
    np.testing.assert_allclose(own.weights[TORQUE], expected)


def test_a_warning_tells_of_sensors_for_which_it_matters(read_late):
    """A quiet torque sensor is told of, a tip sensor with much noise is not."""
    sigma = {**NOISE.sigma, TORQUE: 1e-2 * NOISE[TORQUE], TIP: 1e2 * NOISE[TIP]}
    said = warnings_of_times(read_late[2], replace(NOISE, sigma=sigma))
    assert any(TORQUE in warning for warning in said)
    assert not any(TIP in warning for warning in said)


def test_exact_times_need_nothing(late):
    log = log_read_at(0 * late[0])
    assert errors_by_times(log, replay(log)) is None


def test_a_trial_with_exact_times_stays_beside_one_without(late):
    log = uncertain(log_read_at(late[0]), late[1:])
    exact = replace(log.trials[0], time_errors_s=None)
    both = replace(log, trials=(*log.trials, exact))
    errors = errors_by_times(both, replay(both))
    assert max(own.max() for own in errors.whole[1].values()) == 0.0

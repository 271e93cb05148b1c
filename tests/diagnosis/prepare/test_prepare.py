"""From a log to what can be replayed."""

import numpy as np
import pytest
from diagnosis_fixtures import BASE, TIP, log_with, trial, turns

from diagnosis.log.trial import Trial
from diagnosis.prepare.prepare import prepare


@pytest.fixture
def noisy():
    """A trial whose encoder has noise, with a gap while the base holds."""
    rng = np.random.default_rng(1)
    angle = turns()
    table = trial(angle + rng.normal(0, BASE, angle.size)).table
    table = table.assign(tip_angle_deg=rng.normal(0, TIP, angle.size))
    return Trial(name="trial_01.csv", table=table.drop(index=range(300, 320)).reset_index(drop=True))


def test_the_motion_is_not_the_reading_where_there_is_noise(noisy):
    log, sigma_deg = prepare(log_with(noisy))
    ready = log.trials[0]
    assert sigma_deg == BASE  # as rig.yaml claims, since the readings agree
    assert not np.array_equal(ready.base_motion_deg[ready.logged], noisy["base_angle_deg"])
    truth = np.interp(ready.time_s, 0.01 * np.arange(turns().size), turns())
    left = np.sqrt(np.mean((ready.base_motion_deg - truth) ** 2))
    read = np.sqrt(np.mean((noisy["base_angle_deg"] - truth[ready.logged]) ** 2))
    assert left < 0.5 * read


def test_the_logged_rows_are_exactly_the_samples(noisy):
    ready = prepare(log_with(noisy))[0].trials[0]
    assert ready.time_s.size == noisy["time_s"].size + 20
    np.testing.assert_array_equal(ready.time_s[ready.logged], noisy["time_s"])
    np.testing.assert_array_equal(ready.readings["tip_angle_deg"][ready.logged], noisy["tip_angle_deg"])
    assert np.isnan(ready.readings["tip_angle_deg"][~ready.logged]).all()


def test_an_encoder_without_noise_is_believed():
    still = trial(np.round(turns(), 1))
    quiet = log_with(still)
    log, sigma_deg = prepare(quiet)
    # A staircase of 0.1 deg in a tenth of the samples: far from the claim of 0.02 deg.
    assert sigma_deg < BASE / 2
    np.testing.assert_allclose(log.trials[0].base_motion_deg, still["base_angle_deg"], atol=BASE)

"""Noise that is another one in each trial, told by differences of what an explanation leaves."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import prepared, trial

from diagnosis.log.white_noise import white_noise
from diagnosis.prepare.noise.noise_of_trials import noise_of_trials

SAMPLES = 1500
RATIOS = (0.7, 0.95, 1.0, 1.25)
SMALL = 0.8  # of the noise that it was taken for


@pytest.fixture(scope="module")
def trials():
    """Four trials of 15 s in which the base turns."""
    one = prepared(trial(30 * np.sin(0.5 * np.arange(0, SAMPLES / 100, 0.01))))
    return [replace(one, name=f"trial_{i}.csv") for i in range(len(RATIOS))]


def normal(seed):
    return np.random.default_rng(seed).normal(size=(len(RATIOS), SAMPLES))


def told(trials, noise):
    return noise_of_trials(list(zip(trials, noise, strict=True)))


def test_the_noise_of_each_trial_is_measured(trials):
    """The logarithm of it scatters by sqrt(1.25 / 1500) = 3 %, three times that."""
    found = told(trials, SMALL * np.array(RATIOS)[:, None] * normal(1))
    rms = np.sqrt(np.mean(np.square(RATIOS)))
    for one, ratio in zip(trials, RATIOS, strict=True):
        np.testing.assert_allclose(found.sizes(one), ratio / rms, rtol=0.09)
        assert found.sizes(one).shape == one.time_s.shape
    assert found.noise_ratio == pytest.approx(SMALL * rms, rel=0.09)


def test_ratios_have_the_mean_square_1_over_all_readings(trials):
    noise = np.array(RATIOS)[:, None] * normal(2)
    noise[0, SAMPLES // 3 :] = np.nan  # a sensor that was off
    found = told(trials, noise)
    readings = np.isfinite(noise).sum(axis=1)
    squares = np.array([found.ratios[one.name] ** 2 for one in trials])
    assert readings @ squares / readings.sum() == pytest.approx(1.0)


@pytest.mark.parametrize("seed", range(5))
def test_noise_of_one_size_is_the_same_in_all_trials(trials, seed):
    assert told(trials, normal(seed)) is None


@pytest.mark.parametrize("seed", range(5))
def test_heavy_tails_are_the_same_in_all_trials(trials, seed):
    noise = np.random.default_rng(seed).standard_t(3, size=(len(RATIOS), SAMPLES))
    assert told(trials, noise) is None


def test_one_outlier_in_fifty_makes_no_other_noise(trials):
    noise = normal(3)
    noise[0, ::50] += 17.0
    assert told(trials, noise) is None


def test_a_small_difference_does_not_count_however_certain(trials):
    """Of a noise that is 10 % larger in one trial, and of very long trials."""
    many = np.random.default_rng(4).normal(size=(len(RATIOS), 200_000))
    many[0] *= 1.1
    assert told(trials, many) is None
    many[0] *= 1.1
    assert told(trials, many) is not None


def test_what_swings_fast_in_one_trial_is_no_noise(trials):
    """Off in the same way from sample to sample: differences of the fourth order show less of it."""
    noise = normal(5)
    noise[1] += 5.0 * np.sin(2 * np.pi * 6.0 * np.arange(SAMPLES) / 100)
    assert told(trials, noise) is None


def test_one_trial_or_too_short_a_one_tells_nothing(trials):
    noise = np.array(RATIOS)[:, None] * normal(6)
    assert told(trials[:1], noise[:1]) is None
    noise[0, 10:] = np.nan
    assert told(trials, noise) is None


def test_it_is_told_in_words(trials):
    found = told(trials, np.array(RATIOS)[:, None] * normal(7))
    least, most = min(found.ratios.values()), max(found.ratios.values())
    assert found.in_words.endswith(f"between {least:.2f} and {most:.2f} times its mean")


def test_a_trial_that_was_not_read_counts_as_the_mean(trials):
    found = told(trials[1:], np.array(RATIOS[1:])[:, None] * normal(8)[1:])
    np.testing.assert_array_equal(found.sizes(trials[0]), 1.0)


def test_the_logarithm_scatters_as_derived():
    """Of 400 trials of 1500 readings, the variance of it is known to 7 %, three times that."""
    rng = np.random.default_rng(9)
    sizes = [np.log(white_noise([rng.normal(size=SAMPLES)], order=2)) for _ in range(400)]
    assert SAMPLES * np.var(sizes) == pytest.approx(1.25, rel=0.21)

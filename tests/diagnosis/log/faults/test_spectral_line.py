"""A line in readings, against one of known size."""

import numpy as np
import pytest

from diagnosis.log.faults.spectral_line import line_in, power_over_neighbours

EVEN = np.arange(0, 20, 0.01)
UNEVEN = np.sort(np.random.default_rng(2).uniform(0, 20, 1500))


@pytest.mark.parametrize("time_s", [EVEN, UNEVEN], ids=["even", "uneven"])
def test_a_line_beside_a_slow_signal_is_found_in_full(time_s):
    line = 0.3 * np.cos(2 * np.pi * 30.0 * time_s + 0.7)
    found = line_in(time_s, line + 50 * np.sin(0.5 * time_s), 30.0)
    # Between means the signal bends by 50 0.5^2 0.1^2 / 8 = 0.016, of which little is at 30 Hz.
    np.testing.assert_allclose(found, line, atol=0.002)


def test_at_half_the_sampling_rate_there_is_a_cosine_alone():
    line = 0.3 * np.cos(2 * np.pi * 50.0 * EVEN)
    np.testing.assert_allclose(line_in(EVEN, line, 50.0), line, atol=1e-3)


def test_the_power_of_noise_is_that_beside_it_and_of_a_line_far_above():
    tried = 30.0 + 0.01 * np.arange(-20, 21)
    noise = np.random.default_rng(3).normal(0, 1.0, (40, EVEN.size))
    each = [power_over_neighbours(EVEN, own, tried)[20] for own in noise]
    # An exponential distribution: a standard deviation of its mean, over 40 draws.
    assert np.mean(each) == pytest.approx(1.0, abs=3.5 / np.sqrt(40))
    humming = noise[0] + 0.5 * np.sin(2 * np.pi * 30.0 * EVEN)
    power = power_over_neighbours(EVEN, humming, tried)
    assert tried[np.argmax(power)] == pytest.approx(30.0, abs=0.011)
    # A quarter of the amplitude squared, times the readings that a Hann window counts, two thirds.
    assert power.max() == pytest.approx(0.25 * 0.5**2 * EVEN.size * 2 / 3, rel=0.4)


def test_readings_of_nothing_have_no_power():
    assert not power_over_neighbours(EVEN, np.zeros(EVEN.size), np.array([29.9, 30.0, 30.1])).any()

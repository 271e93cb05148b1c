"""Spectrum of a residual, against closed forms."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.residuals.spectrum import spectrum

STEP = 0.01


def white(size, seed=0):
    return np.random.default_rng(seed).normal(size=size)


def test_white_noise_is_at_its_level_at_all_frequencies():
    found = spectrum([white(20_000, seed) for seed in range(3)], STEP)
    hertz, power = np.transpose(found.power_per_hz)
    assert found.white_per_hz == 2 * STEP
    assert hertz[0] == pytest.approx(0.1)
    assert 40 < hertz[-1] <= 50
    # 120 overlapping segments of a Hann window are some 60 independent ones: 13 % at a single frequency.
    np.testing.assert_allclose(power, 2 * STEP, rtol=4 * 0.13)
    np.testing.assert_allclose(power[hertz > 5], 2 * STEP, rtol=0.06)


def test_the_spectrum_of_an_autoregressive_residual_is_its_closed_form():
    phi = 0.9
    residual = lfilter([np.sqrt(1 - phi**2)], [1, -phi], white(200_000))
    hertz, power = np.transpose(spectrum([residual], STEP).power_per_hz)
    exact = 2 * STEP * (1 - phi**2) / np.abs(1 - phi * np.exp(-2j * np.pi * hertz * STEP)) ** 2
    # 390 segments: 5 to 7 % at a single frequency; the mean of a third of an octave is over a curve.
    np.testing.assert_allclose(power, exact, rtol=0.25)
    assert power[0] / power[-1] > 200


def test_a_sine_is_found_at_its_frequency_with_its_power():
    time = STEP * np.arange(10_000)
    hertz, power = np.transpose(spectrum([2 * np.sin(2 * np.pi * 2.0 * time)], STEP).power_per_hz)
    assert hertz[np.argmax(power)] == pytest.approx(2.0, rel=0.15)


def test_missing_samples_and_short_trials_do_not_change_the_level():
    gappy = white(20_000)
    gappy[::3] = np.nan
    short = white(300, seed=1)
    found = spectrum([gappy, short], STEP)
    power = np.transpose(found.power_per_hz)[1]
    np.testing.assert_allclose(np.mean(power[-6:]), found.white_per_hz, rtol=0.05)


def test_a_slow_log_has_segments_that_tell_frequencies_apart():
    hertz = np.transpose(spectrum([white(1000)], 2.0).power_per_hz)[0]
    assert hertz[0] == pytest.approx(1 / 256)
    assert hertz.size > 15


def test_a_few_samples_have_no_spectrum():
    assert spectrum([np.ones(2)], STEP) is None

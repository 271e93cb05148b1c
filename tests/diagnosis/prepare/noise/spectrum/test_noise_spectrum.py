"""Colour of noise, from the spectrum of residuals that also hold what a model lacks."""

import numpy as np
import pytest
from scipy.signal import butter, lfilter, sosfilt

from diagnosis.prepare.noise.autoregression import Autoregression
from diagnosis.prepare.noise.spectrum.noise_spectrum import noise_colour

RATE_HZ = 100


def noise(rng, seconds=30.0, share=0.0, correlation_time_s=0.1):
    """Of variance 1."""
    size = round(seconds * RATE_HZ)
    kept = np.exp(-1 / (RATE_HZ * correlation_time_s))
    start = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=size + 20 * RATE_HZ))
    return np.sqrt(1 - share) * rng.normal(size=size) + np.sqrt(share) * start[20 * RATE_HZ :]


def trials(seed, count=4, **colour):
    rng = np.random.default_rng(seed)
    each = [noise(rng, **colour) for _ in range(count)]
    return [(np.arange(values.size) / RATE_HZ, values) for values in each]


@pytest.mark.parametrize(("share", "time_s"), [(1.0, 0.02), (0.5, 0.05), (1.0, 0.1), (0.6, 0.2)])
def test_colour_is_found_alone_and_beside_white_noise(share, time_s):
    sigma, colour = noise_colour(trials(1, share=share, correlation_time_s=time_s))
    # 120 s hold some 120 / (2 time_s) independent values: the variance is good to sqrt(4 time_s / 120).
    error = 3 * np.sqrt(4 * time_s / 120)
    assert sigma == pytest.approx(1.0, abs=0.5 * error + 0.03)
    assert colour.share == pytest.approx(share, abs=0.1)
    # Power at low frequencies, 2 share time_s, is what effects are judged by.
    assert sigma**2 * colour.share * colour.parts[0].correlation_time_s == pytest.approx(
        share * time_s, rel=0.45
    )


def test_colour_is_found_where_samples_are_missing():
    rng = np.random.default_rng(2)
    parts = trials(2, share=1.0, correlation_time_s=0.1)
    for _, values in parts:
        values[rng.random(values.size) < 0.25] = np.nan
    sigma, colour = noise_colour(parts)
    assert colour.share > 0.95
    assert sigma**2 * colour.parts[0].correlation_time_s == pytest.approx(0.1, rel=0.45)


def test_white_noise_is_white_with_and_without_missing_samples():
    for seed in range(20):
        parts = trials(10 + seed, count=3, seconds=20.0)
        for _, values in parts[: seed % 2]:
            values[::3] = np.nan
        assert noise_colour(parts) is None


def test_what_is_slow_or_comes_in_bursts_is_no_noise():
    """Relaxation after a turn every 5 s, twenty times the noise, and a drift."""
    parts = trials(3)
    for time_s, values in parts:
        since = time_s % 5.0
        values[:] += 20 * np.exp(-since / 0.3) * (-1) ** (time_s // 5) + 0.5 * time_s
    assert noise_colour(parts) is None


def test_what_is_slow_does_not_change_the_colour_that_is_found():
    (alone, colour), parts = (noise_colour(trials(4, share=0.5)), trials(4, share=0.5))
    for time_s, values in parts:
        values[:] += 5 * np.sin(2 * np.pi * 0.1 * time_s)
    sigma, found = noise_colour(parts)
    power = (sigma**2 * found.share * found.parts[0].correlation_time_s) / (
        alone**2 * colour.share * colour.parts[0].correlation_time_s
    )
    assert 0.5 < power < 2.0


def test_too_few_windows_tell_no_colour():
    assert noise_colour(trials(5, count=1, seconds=3.0, share=1.0)) is None
    assert noise_colour([]) is None


def test_a_small_share_is_no_colour_where_more_is_asked_for():
    parts = trials(6, share=0.35, correlation_time_s=0.1)
    assert noise_colour(parts)[1].share == pytest.approx(0.35, abs=0.1)
    assert noise_colour(parts, least_share=0.5) is None


def test_means_of_coloured_readings_are_told_by_what_means_do_to_them():
    """Of two readings each, of a process that lasts 1.6 steps: a share above 1, and its own time."""
    parts = [
        (values_s[::2], values.reshape(-1, 2).mean(axis=1))
        for values_s, values in trials(7, count=6, share=1.0, correlation_time_s=0.016)
    ]
    _, colour = noise_colour(parts, means_of=2)
    assert colour.share > 1.0
    assert colour.parts[0].correlation_time_s == pytest.approx(0.016, rel=0.35)
    left = np.concatenate([colour.whitened(time_s, values) for time_s, values in parts])
    both = np.mean(left[1:] * left[:-1]) / np.mean(left**2)
    assert abs(both) < 4 / np.sqrt(left.size)


def test_a_colour_that_shows_less_is_found_if_less_is_asked_for():
    parts = trials(8, count=3, seconds=12.0, share=0.25, correlation_time_s=0.02)
    assert noise_colour(parts, least_chi_square=10.0) is not None
    assert noise_colour(parts, least_chi_square=100.0) is None


def swinging(rng, frequency_hz, periods, size=6000):
    """AR(2) noise of variance 1: an oscillation that is forgotten after some periods."""
    kept, turn = np.exp(-frequency_hz / periods / RATE_HZ), 2 * np.pi * frequency_hz / RATE_HZ
    values = lfilter([1.0], [1.0, -2 * kept * np.cos(turn), kept**2], rng.normal(size=size + 1000))
    return values[1000:] / values.std()


@pytest.mark.parametrize(("frequency_hz", "periods"), [(6.0, 0.5), (16.0, 0.6), (20.0, 1.2)])
def test_noise_that_swings_is_whitened(frequency_hz, periods):
    """Its density at frequency 0, by which effects are judged, is that of its model."""
    rng = np.random.default_rng(9)
    parts = [(np.arange(6000) / RATE_HZ, swinging(rng, frequency_hz, periods)) for _ in range(2)]
    sigma, colour = noise_colour(parts)
    # 120 s, 119 windows: the quantile of a band of 8 frequencies is good to 1.7 / sqrt(0.8 * 119 * 8),
    # that of the peak's few bands to 0.05; sigma is its root, and lines of the grid are 10 % apart.
    assert sigma == pytest.approx(1.0, abs=0.1)
    left = np.concatenate([colour.whitened(time_s, values / sigma) for time_s, values in parts])
    assert np.sqrt(np.mean(left**2)) == pytest.approx(1.0, abs=0.06)
    # Means of n white values times sqrt(n) have the same root mean square: here to 1 / sqrt(2 * 480).
    means = 5.0 * left.reshape(-1, 25).mean(axis=1)
    assert np.sqrt(np.mean(means**2)) == pytest.approx(1.0, abs=4 / np.sqrt(2 * means.size) + 0.1)


def test_noise_of_several_correlation_times_is_whitened():
    """1 / f noise, over two decades of time."""
    rng = np.random.default_rng(10)
    parts = []
    for _ in range(4):
        each = [noise(rng, share=1.0, correlation_time_s=time_s) for time_s in (0.005, 0.03, 0.2)]
        parts.append((np.arange(each[0].size) / RATE_HZ, sum(each) / np.sqrt(3)))
    sigma, colour = noise_colour(parts)
    left = np.concatenate([colour.whitened(time_s, values / sigma) for time_s, values in parts])
    means = 5.0 * left.reshape(-1, 25).mean(axis=1)
    assert np.sqrt(np.mean(means**2)) == pytest.approx(1.0, abs=0.2)
    assert np.sqrt(np.mean(left**2)) == pytest.approx(1.0, abs=0.03)


def test_noise_of_a_digital_filter_is_an_autoregression_but_not_beside_much_else():
    """A band-limited sensor; where a model lacks much (one part is asked for), it is none."""
    rng = np.random.default_rng(11)
    filter_ = butter(4, 0.3, output="sos")
    parts = [
        (np.arange(2000) / RATE_HZ, sosfilt(filter_, rng.normal(size=2500))[500:]) for _ in range(4)
    ]
    sigma, colour = noise_colour(parts)
    assert isinstance(colour, Autoregression)
    left = np.concatenate([colour.whitened(time_s, values / sigma) for time_s, values in parts])
    assert left.std() == pytest.approx(1.0, abs=0.04)
    assert not isinstance(noise_colour(parts, most_parts=1)[1], Autoregression)


def test_noise_of_a_process_is_no_autoregression():
    assert not isinstance(noise_colour(trials(1, share=0.6, correlation_time_s=0.1))[1], Autoregression)

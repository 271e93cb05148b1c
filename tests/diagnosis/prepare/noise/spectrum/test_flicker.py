"""Flicker noise: as 1 / f, made from a spectrum of its own."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.criteria.noise import COLOUR_CHI_SQUARE, FLICKER_ABOVE_HZ
from diagnosis.prepare.noise.spectrum.flicker import flicker_noise

RATE_HZ, SECONDS = 100, 40.0
SIZE = round(SECONDS * RATE_HZ)


def one_over_f(rng, exponent=1.0):
    """Of variance 1, with the power of each frequency as 1 / f^exponent from 1 / SECONDS on."""
    waves = np.fft.rfft(rng.normal(size=SIZE))
    waves[0] = 0.0
    waves[1:] /= np.arange(1, waves.size) ** (exponent / 2)
    values = np.fft.irfft(waves, SIZE)
    return values / values.std()


def trials(seed, share=1.0, count=4):
    rng = np.random.default_rng(seed)
    time_s = np.arange(SIZE) / RATE_HZ
    return [
        (time_s, np.sqrt(share) * one_over_f(rng) + np.sqrt(1 - share) * rng.normal(size=SIZE))
        for _ in range(count)
    ]


@pytest.mark.parametrize("share", [0.5, 1.0])
@pytest.mark.parametrize("seed", [1, 2])
def test_it_is_found_with_its_size_though_most_of_it_is_below_the_bands(seed, share):
    found = flicker_noise(trials(seed, share))
    sigma, colour = found.noise
    # A low quantile of 160 windows tells the level of a band to some per cent. The slowest process has
    # the correlation time of a wave of a trial, and half of its power is slower: 1/16 of the variance.
    assert sigma == pytest.approx(1.0, abs=0.15)
    assert colour.share == pytest.approx(share, abs=0.15)
    assert colour.in_words == "as that of 1/f noise"
    assert found.gain_cost > COLOUR_CHI_SQUARE > found.behind_cost


def test_its_parts_have_a_density_as_one_over_f():
    colour = flicker_noise(trials(3)).noise[1]
    times_s = np.array([part.correlation_time_s for part in colour.parts])
    shares = np.array([part.share for part in colour.parts])
    frequency = np.geomspace(1.0 / SECONDS, 0.1 * RATE_HZ, 40)
    # Lorentzians, the transforms of exp(-|t| / tau).
    each = 4 * shares * times_s / (1 + (2 * np.pi * frequency[:, None] * times_s) ** 2)
    power = frequency * each.sum(axis=1)
    within = (frequency > 1.5 / SECONDS) & (frequency < 0.05 * RATE_HZ)
    # A factor of 3.3 between neighbouring times makes waves of 1 %; ends take off some.
    assert power[within].max() / power[within].min() < 1.35


def test_it_leaves_white_noise_with_means_over_seconds_that_are_no_larger():
    parts = trials(4)
    found = flicker_noise(parts)
    sigma, colour = found.noise
    white = [colour.whitened(time_s, values / sigma) for time_s, values in parts]
    blocks = np.concatenate([own.reshape(-1, 200).mean(axis=1) for own in white])
    assert np.std(np.concatenate(white)) == pytest.approx(1.0, abs=0.05)
    # 80 blocks: the root mean square of their means scatters by 8 %.
    assert np.sqrt(200 * np.mean(blocks**2)) < 1.3


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_noise_that_is_somewhat_steeper_leaves_white_noise_too(seed):
    """1 / f alone, fitted above 2 Hz, leaves means over seconds that are 1.4 times as large."""
    rng = np.random.default_rng(seed)
    time_s = np.arange(SIZE) / RATE_HZ
    parts = [(time_s, one_over_f(rng, 1.2)) for _ in range(6)]
    sigma, colour = flicker_noise(parts).noise
    white = np.array([colour.whitened(time_s, values / sigma) for time_s, values in parts])
    blocks = white.reshape(-1, 200).mean(axis=1)
    assert np.std(white) == pytest.approx(1.0, abs=0.05)
    # 120 blocks: the root mean square of their means scatters by 6 %.
    assert np.sqrt(200 * np.mean(blocks**2)) < 1.2


def test_white_noise_and_noise_that_is_forgotten_at_once_are_not_like_that():
    rng = np.random.default_rng(5)
    time_s = np.arange(SIZE) / RATE_HZ
    white = [(time_s, rng.normal(size=SIZE)) for _ in range(4)]
    found = flicker_noise(white)
    assert found is None or found.gain_cost < COLOUR_CHI_SQUARE
    for kept in (0.5, 0.8, 0.95):
        noise = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=(4, SIZE)))
        assert flicker_noise([(time_s, values) for values in noise]).behind_cost > COLOUR_CHI_SQUARE


@pytest.mark.parametrize("time_s", [0.45, 0.6])
@pytest.mark.parametrize("seed", [6, 7])
def test_a_process_that_is_forgotten_slowly_is_told_from_flicker(time_s, seed):
    rng = np.random.default_rng(seed)
    kept = np.exp(-1 / (RATE_HZ * time_s))
    noise = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=(8, SIZE)))
    at_s = np.arange(SIZE) / RATE_HZ
    found = flicker_noise(
        [(at_s, own + 0.7 * rng.normal(size=SIZE)) for own in noise], 1, FLICKER_ABOVE_HZ
    )
    sigma, colour = found.noise
    (part,) = colour.parts
    # Two bands of 0.5 Hz, of a hundred windows each, tell where the density bends: to a third.
    assert part.correlation_time_s == pytest.approx(time_s, rel=0.35)
    assert sigma == pytest.approx(np.sqrt(1.0 + 0.7**2), rel=0.15)
    assert "1/f" not in colour.in_words
    assert found.gain_cost > COLOUR_CHI_SQUARE


def test_what_is_slow_does_not_change_it():
    alone, parts = flicker_noise(trials(6)).noise[0], trials(6)
    for time_s, values in parts:
        values[:] += 5 * np.sin(2 * np.pi * 0.1 * time_s)
    assert flicker_noise(parts).noise[0] == pytest.approx(alone, rel=0.05)


def test_flicker_that_begins_at_one_hertz_shows_below_the_bands_of_other_noise():
    """White noise of variance 1 beside a density of 1 / f, in Hz, of white noise."""
    rng = np.random.default_rng(8)
    frequency = np.fft.rfftfreq(SIZE, 1.0 / RATE_HZ)
    size = np.ones(frequency.size)
    size[1:] = np.sqrt(1.0 + 1.0 / frequency[1:])
    waves = np.fft.rfft(rng.normal(size=(4, SIZE))) * size
    parts = [(np.arange(SIZE) / RATE_HZ, values) for values in np.fft.irfft(waves, SIZE)]
    seen = flicker_noise(parts, above_hz=FLICKER_ABOVE_HZ)
    assert seen.gain_cost > COLOUR_CHI_SQUARE
    # Its variance: the integral of 1 / f over that of white noise, ln(f high / f low) / (f high).
    expected = np.log(0.5 * RATE_HZ * SECONDS) / (0.5 * RATE_HZ)
    sigma, colour = seen.noise
    assert sigma**2 * colour.share == pytest.approx(expected, rel=0.5)


def test_too_few_windows_tell_nothing():
    time_s = np.arange(300) / RATE_HZ
    assert flicker_noise([(time_s, np.random.default_rng(7).normal(size=300))]) is None
    assert flicker_noise([]) is None

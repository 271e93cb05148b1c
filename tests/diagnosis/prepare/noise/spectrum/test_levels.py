"""Levels of a spectrum, against the spectral density of noise that is known."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.prepare.noise.spectrum.levels import process, processes, spectrum_of

RATE_HZ, SIZE = 100, 3000


def trials(seed, *, kept=0.0, share=0.0, count=6, missing=0.0):
    """White noise beside noise that is correlated from sample to sample, of variance 1 together."""
    rng = np.random.default_rng(seed)
    white, slow = rng.normal(size=(2, count, SIZE))
    slow = lfilter([np.sqrt(1 - kept**2)], [1, -kept], slow)
    values = np.sqrt(1 - share) * white + np.sqrt(share) * slow
    values[rng.random(values.shape) < missing] = np.nan
    return [(np.arange(SIZE) / RATE_HZ, own) for own in values]


@pytest.mark.parametrize("missing", [0.0, 0.2])
def test_levels_of_white_noise_are_as_expected_within_their_error(missing):
    spectrum = spectrum_of(trials(1, missing=missing))
    off = np.log(spectrum.levels / spectrum.white) / spectrum.error
    # Standard normal: the root mean square of a dozen scatters by a fifth.
    assert np.sqrt(np.mean(off**2)) == pytest.approx(1.0, abs=0.65)


@pytest.mark.parametrize("missing", [0.0, 0.2])
def test_levels_of_correlated_noise_follow_its_density(missing):
    """A Lorentzian, of the sampled process: (1 - p^2) / (1 - 2 p cos(2 pi f h) + p^2)."""
    kept = 0.9
    spectrum = spectrum_of(trials(2, kept=kept, share=1.0, missing=missing))
    own = process(spectrum, -1.0 / (RATE_HZ * np.log(kept)), 1)
    off = np.log(spectrum.levels / own.levels) / spectrum.error
    assert np.sqrt(np.mean(off**2)) == pytest.approx(1.0, abs=0.65)
    frequency = np.array([1.5, 2.0])  # of the first band
    density = (1 - kept**2) / (1 - 2 * kept * np.cos(2 * np.pi * frequency / RATE_HZ) + kept**2)
    # Samples that are missing at random leave so much of it, and make the rest white. The tapered
    # window shows neighbours as well, and a parabola is missing: some per cent.
    expected = (1 - missing) * density.mean() + missing
    assert own.levels[0] / spectrum.white[0] == pytest.approx(expected, rel=0.1)


def test_the_last_band_is_as_the_others_without_half_the_sampling_rate():
    """There a periodogram scatters as chi-square with one degree of freedom, not two."""
    each = [spectrum_of(trials(seed)) for seed in range(10, 30)]
    off = [np.log(one.levels[-1] / one.white[-1]) / one.error[-1] for one in each]
    assert abs(np.mean(off)) < 3.0 / np.sqrt(len(off))


def test_the_sizes_of_what_is_there_are_found():
    spectrum = spectrum_of(trials(3, kept=0.9, share=0.4, count=10))
    own = process(spectrum, -1.0 / (RATE_HZ * np.log(0.9)), 1)
    cost, sizes = spectrum.fitted(np.column_stack([spectrum.white, own.levels]))
    np.testing.assert_allclose(sizes, [0.6, 0.4], atol=0.06)
    alone, _ = spectrum.fitted(spectrum.white[:, None])
    assert alone > cost + 100.0
    least = min(
        spectrum.fitted(np.column_stack([spectrum.white, one.levels]))[0]
        for one in processes(spectrum, 1)
    )
    assert least <= cost + 1.0  # its correlation time is among those that are tried, nearly


def test_bands_may_begin_below_the_frequencies_of_effects_in_longer_windows():
    parts = trials(4, kept=0.98, share=0.5)
    usual, slow = spectrum_of(parts), spectrum_of(parts, above_hz=0.5, window_s=6.0)
    assert slow.lag_weights.shape[1] == 3 * usual.lag_weights.shape[1]
    one = process(slow, -1.0 / (RATE_HZ * np.log(0.98)), 1)
    _, sizes = slow.fitted(np.column_stack([slow.white, one.levels]))
    np.testing.assert_allclose(sizes, [0.5, 0.5], atol=0.15)
    assert slow.levels[0] / slow.levels[-1] > usual.levels[0] / usual.levels[-1]


def test_what_is_slower_than_a_window_does_not_show():
    """A parabola is subtracted from each."""
    parts = trials(5)
    drifting = [(time_s, values + 3.0 * time_s + 0.5 * time_s**2) for time_s, values in parts]
    np.testing.assert_allclose(spectrum_of(drifting).levels, spectrum_of(parts).levels, rtol=1e-6)


def test_trials_that_are_too_short_have_no_spectrum():
    assert spectrum_of([]) is None
    assert spectrum_of(trials(6)[:1], above_hz=0.1, window_s=29.0) is None


def test_of_trials_at_many_rates_the_step_is_one_that_leaves_enough_windows():
    """Of 8 s at 500 Hz there are 7 windows of 2 s, of 12; at 100 Hz every other value is missing."""
    kept_s, rng = 0.05, np.random.default_rng(5)

    def trial(rate_hz, lasting_s):
        kept, size = np.exp(-1.0 / (kept_s * rate_hz)), round(rate_hz * lasting_s)
        own = lfilter([np.sqrt(1 - kept**2)], [1, -kept], rng.normal(size=size))
        return np.arange(size) / rate_hz, own

    fast = trial(500, 8.0)
    assert spectrum_of([fast]) is None
    spectrum = spectrum_of([fast, trial(200, 12.0), *(trial(100, 12.0) for _ in range(2))])
    assert spectrum.step_s == pytest.approx(1 / 200)
    own = process(spectrum, kept_s, 1)
    off = np.log(spectrum.levels / own.levels) / spectrum.error
    assert np.sqrt(np.mean(off**2)) == pytest.approx(1.0, abs=0.65)

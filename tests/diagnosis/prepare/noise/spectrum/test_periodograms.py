"""Periodograms of windows of a residual."""

import numpy as np
import pytest

from diagnosis.prepare.noise.spectrum.periodograms import (
    MEAN,
    QUANTILE,
    even,
    periodogram,
    step_of,
    steps_of_trials,
    taper_of,
    windows_of,
)

RATE_HZ = 100


def trial(seconds=40.0, seed=1):
    time_s = np.arange(round(seconds * RATE_HZ)) / RATE_HZ
    return time_s, np.random.default_rng(seed).normal(size=time_s.size)


def cut_into_windows(time_s, values):
    return windows_of([even(time_s, values, 1 / RATE_HZ)], 1 / RATE_HZ)


def levels(cut):
    return np.array([periodogram(values, taper_of(values.size)) for values in cut])


def test_windows_overlap_by_half_and_have_enough_samples():
    time_s, values = trial(seconds=10.0)
    assert len(cut_into_windows(time_s, values)) == 9  # 2 s each
    there = (time_s < 4.0) | (time_s > 5.6)
    # Those from 3 and 4 s on hold 1.0 and 0.4 s of 2: the second is left out.
    cut = cut_into_windows(time_s[there], values[there])
    assert len(cut) == 8
    assert np.isnan(np.concatenate(cut)).any()


@pytest.mark.parametrize("kept", [1.0, 0.7])
def test_the_level_of_white_noise_is_its_variance_also_where_samples_are_missing(kept):
    time_s, values = trial(seconds=200.0)
    values[np.random.default_rng(2).random(values.size) > kept] = np.nan
    shown = levels(cut_into_windows(time_s, values))[:, 5:-5]
    # 200 windows of 90 frequencies: 18 000 values, each scattering by its own size.
    assert shown.mean() == pytest.approx(1.0, abs=3 / np.sqrt(0.5 * shown.size))
    assert np.quantile(shown, QUANTILE) / MEAN == pytest.approx(1.0, abs=0.06)


def test_what_is_filled_in_is_cut_into_the_windows_of_what_was_read():
    read, filled = np.ones(400), np.arange(400.0)
    read[:150] = np.nan  # of the first window too much is missing
    cut = windows_of([read], 1 / RATE_HZ, [filled])
    assert [own[0] for own in cut] == [100.0, 200.0]


def test_a_parabola_leaves_nothing():
    time_s, _ = trial(seconds=2.0)
    (values,) = cut_into_windows(time_s, 3.0 - time_s + 5.0 * time_s**2)
    assert periodogram(values, taper_of(values.size)).max() < 1e-20


def test_the_step_is_that_of_most_samples():
    assert step_of([trial()]) == pytest.approx(0.01)
    assert np.isnan(step_of([]))
    assert np.isnan(step_of([(np.array([1.0]), np.array([2.0]))]))


def test_steps_are_that_of_most_samples_and_those_of_slower_trials():
    each = [(np.arange(size) / rate, np.zeros(size)) for rate, size in ((500, 900), (50, 80), (100, 80))]
    assert steps_of_trials(each) == pytest.approx([0.002, 0.01, 0.02])
    assert steps_of_trials([]) == []

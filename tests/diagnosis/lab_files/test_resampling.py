"""Resampling against signals that are known at all times."""

import numpy as np
import pytest

from diagnosis.lab_files.resampling import decimation, rate_hz, resampled, told

WANTED = np.arange(0, 4, 0.01)


def test_a_slow_sine_passes_and_a_fast_one_is_removed():
    """1 kHz to 100 Hz: 2 Hz passes; 110 Hz, which would fold back to 10 Hz, does not."""
    time = np.arange(0, 4, 0.001)
    slow, fast = np.sin(2 * np.pi * 2 * time), np.sin(2 * np.pi * 110 * time)
    found = resampled(time, slow + fast, WANTED, across_gaps=False)
    inside = slice(20, -20)
    exact = np.sin(2 * np.pi * 2 * WANTED)
    # scipy's filter (Kaiser window, beta 5) leaves about 1 % beyond its edge.
    np.testing.assert_allclose(found[inside], exact[inside], atol=0.02)
    assert np.abs(fast[::10][inside]).max() > 0.5  # what leaving out samples alone would keep


def test_a_slower_signal_is_interpolated_by_straight_lines():
    time = np.array([0.0, 1.0, 2.0, 3.0, 4.0])
    values = np.array([0.0, 2.0, 2.0, 0.0, 1.0])
    found = resampled(time, values, WANTED, across_gaps=False)
    np.testing.assert_allclose(found, np.interp(WANTED, time, values))


def test_a_pause_stays_a_pause_unless_it_is_to_be_crossed():
    time = np.concatenate((np.arange(0, 1, 0.02), np.arange(2, 4, 0.02)))
    values = time.copy()
    found = resampled(time, values, WANTED, across_gaps=False)
    pause = (WANTED > 0.995) & (WANTED < 1.985)  # half a step from either side
    assert np.isnan(found[pause]).all()
    assert np.isfinite(found[~pause & (WANTED < 3.98)]).all()
    crossed = resampled(time, values, WANTED, across_gaps=True)
    np.testing.assert_allclose(crossed[:395], WANTED[:395], atol=1e-9)


def test_nothing_is_made_up_outside_of_the_record():
    time = np.arange(1, 2, 0.02)
    found = resampled(time, np.ones(time.size), WANTED, across_gaps=True)
    assert np.isnan(found[(WANTED < 0.9) | (WANTED > 2.1)]).all()
    assert np.isnan(resampled(time[:1], time[:1], WANTED, across_gaps=True)).all()


def test_what_is_done_is_told():
    time = np.arange(0, 1, 0.001)
    assert rate_hz(time) == pytest.approx(1000)
    assert decimation(time, 100) == 10
    assert "low-pass below 50 Hz" in told(time, 100)
    assert "straight lines" in told(time[::50], 100)

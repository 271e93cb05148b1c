"""A motion through readings that scatter in time."""

import numpy as np
import pytest

from diagnosis.log.times.adaptive_curve import Scatter, adaptive_curve

STEP_S, READINGS = 0.05, 400
TIMES = STEP_S * np.arange(READINGS)
ROWS = np.arange(READINGS)
SCATTER = Scatter(noise_deg=0.02, jitter_s=0.006)
CORNER = 200


def curve_of(base, rows=ROWS, scatter=SCATTER):
    return adaptive_curve(base, rows, STEP_S, scatter)


def corner(time_s):
    return 100.0 * np.abs(time_s - TIMES[CORNER])


def read(motion, seed):
    rng = np.random.default_rng(seed)
    late = rng.normal(0, SCATTER.jitter_s, READINGS)
    return motion(TIMES + late) + rng.normal(0, SCATTER.noise_deg, READINGS)


def test_exact_readings_of_a_cubic_are_met_also_far_from_zero_and_with_rows_missing():
    motion = np.polynomial.Polynomial([4e4, 30.0, -12.0, 0.8])
    kept = np.delete(ROWS, [7, 8, 100, 250])
    found = curve_of(motion(TIMES[kept]), kept, Scatter(noise_deg=1e-6, jitter_s=1e-8))
    np.testing.assert_allclose(found.angle_deg, motion(TIMES[kept]), rtol=0, atol=1e-5)
    np.testing.assert_allclose(found.rate_deg_s, motion.deriv()(TIMES[kept]), rtol=0, atol=1e-3)


def test_on_a_straight_motion_wide_windows_count():
    """A line through 33 readings has 1 / 33 of their variance in its middle, 4 / 33 at its ends.

    The mean is no better than the widest window, and no worse than a line through 9.
    """
    share = curve_of(30.0 * TIMES).own_share[50:-50]
    assert share.min() > 1 / 41
    assert share.max() < 1 / 9


def test_the_variance_is_that_of_the_readings_times_their_share():
    """Over 400 readings a variance scatters by sqrt(2 / 400) = 7 %; the choice of windows adds some."""
    at = slice(100, 300, 20)
    each = [curve_of(read(lambda t: 100.0 * t, seed)) for seed in range(40)]
    off = np.array([found.angle_deg[at] - 100.0 * TIMES[at] for found in each])
    reading = SCATTER.noise_deg**2 + (100 * SCATTER.jitter_s) ** 2
    told = np.mean([found.own_share[at] for found in each]) * reading
    assert np.mean(off**2) == pytest.approx(told, rel=0.3)


def test_beside_a_corner_the_curve_is_nearer_than_a_centred_cubic():
    """Which misses it by a tenth of (change of rate) x (width)."""
    near = slice(CORNER - 3, CORNER + 4)
    off = [curve_of(read(corner, seed)).angle_deg - corner(TIMES) for seed in range(25)]
    rms = np.sqrt(np.mean(np.square(off)[:, near], axis=0))
    cubic = [np.polyfit(TIMES[i - 5 : i + 6], corner(TIMES[i - 5 : i + 6]), 3) for i in ROWS[near]]
    missed = [np.polyval(c, TIMES[i]) - corner(TIMES[i]) for c, i in zip(cubic, ROWS[near], strict=True)]
    assert np.sqrt(np.mean(rms**2)) < 0.7 * np.sqrt(np.mean(np.square(missed)))


@pytest.mark.parametrize("readings", [3, 4])
def test_too_few_readings_tell_nothing(readings):
    found = curve_of(TIMES[:readings], ROWS[:readings])
    assert np.isnan(found.angle_deg).all()


def test_readings_without_scatter_are_no_error():
    still = Scatter(noise_deg=0.0, jitter_s=0.0)
    assert np.isfinite(curve_of(corner(TIMES), scatter=still).angle_deg[20:-20]).all()

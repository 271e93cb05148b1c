"""Curves through neighbours."""

import numpy as np
import pytest

from diagnosis.log.local_curves import interpolated, least_squares, robust_curve

RNG = np.random.default_rng(1)
TIME = np.cumsum(RNG.uniform(0.5, 1.5, 200))


def test_a_cubic_is_met_over_uneven_times():
    values = 1 + 2 * TIME - 0.03 * TIME**2 + 1e-4 * TIME**3
    said, gain = interpolated(TIME, values, 1, 2)
    np.testing.assert_allclose(said[2:-2], values[2:-2], rtol=1e-9)
    assert np.isnan(said[[0, 1, -2, -1]]).all()
    assert (gain[2:-2] > 1).all()


def test_the_gain_is_that_of_white_noise():
    even = np.arange(50_000.0)
    noise = RNG.normal(0, 1, even.size)
    said, gain = interpolated(even, noise, 1, 2)
    assert gain[100] == pytest.approx(np.sqrt(1 + 34 / 36))
    # 50 000 correlated samples: a standard error below 1 %.
    assert np.nanstd(noise - said) == pytest.approx(gain[100], rel=0.03)


def windows(count=5, width=15):
    """A parabola in each of some windows."""
    x = np.tile(np.linspace(-1, 1, width), (count, 1))
    return x[:, :, None] ** np.arange(3), 1 + x + 0.5 * x**2


def test_least_squares_meets_what_it_can_and_says_its_variance():
    powers, y = windows()
    curve, variance = least_squares(powers, y, np.ones(y.shape))
    np.testing.assert_allclose(curve, y, atol=1e-7)
    # The trace of the projection is the number of parameters.
    np.testing.assert_allclose(variance.sum(axis=1), 3, rtol=1e-6)


def test_a_robust_curve_does_not_mind_outliers():
    powers, y = windows()
    bad = y.copy()
    bad[:, [3, 9]] += [[100.0, -50.0]]
    np.testing.assert_allclose(robust_curve(powers, bad, np.full(5, 0.01)), y, atol=0.02)

"""Noise that is correlated in time, and what is left of it once its past is known."""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular

from diagnosis.prepare.noise.noise_colour import NoiseColour, covariances_of_means

HALF = NoiseColour(share=0.6, correlation_time_s=0.05)


def uneven(size=300, seed=1):
    return np.cumsum(np.random.default_rng(seed).uniform(0.004, 0.03, size))


def covariance(colour, time_s):
    apart = np.abs(time_s[:, None] - time_s)
    coloured = colour.share * np.exp(-apart / colour.correlation_time_s)
    return coloured + (1 - colour.share) * np.eye(time_s.size)


@pytest.mark.parametrize("share", [0.6, 1.0])
def test_whitening_is_the_inverse_root_of_the_covariance_at_any_times(share):
    """The Cholesky factor is the one lower triangular root: the Kalman filter applies its inverse."""
    colour, time_s = NoiseColour(share=share, correlation_time_s=0.05), uneven()
    values = np.random.default_rng(2).normal(size=(time_s.size, 3))
    root = cholesky(covariance(colour, time_s), lower=True)
    expected = solve_triangular(root, values, lower=True)
    np.testing.assert_allclose(colour.whitened(time_s, values), expected, atol=1e-10)
    np.testing.assert_allclose(colour.whitened(time_s, values[:, 1]), expected[:, 1], atol=1e-10)
    assert colour.uncertainty(time_s) == pytest.approx(2 * np.log(np.diag(root)).sum())


def test_what_was_whitened_can_be_restored():
    time_s = uneven()
    values = np.random.default_rng(3).normal(size=(time_s.size, 2))
    again = HALF.restored(time_s, HALF.whitened(time_s, values))
    np.testing.assert_allclose(again, values, atol=1e-12)


def test_density_is_the_sum_of_the_autocovariances():
    lags_s = 0.01 * np.arange(-2000, 2001)
    summed = 0.4 + 0.6 * np.exp(-np.abs(lags_s) / 0.05).sum()
    assert HALF.density(0.01) == pytest.approx(summed)
    # Noise that forgets within a step is white.
    assert NoiseColour(share=1.0, correlation_time_s=1e-3).density(0.05) == pytest.approx(1.0)


@pytest.mark.parametrize(("count", "time_s"), [(1, 0.02), (2, 0.008), (5, 0.015)])
def test_covariances_of_means_are_those_of_the_means_of_all_pairs_of_readings(count, time_s):
    step_s, lags = 0.01, np.arange(6)
    at_s = step_s / count * np.arange(6 * count)
    readings = np.exp(-np.abs(at_s[:, None] - at_s) / time_s)
    means = readings.reshape(6, count, 6, count).mean(axis=(1, 3))
    found, later = covariances_of_means(lags * step_s, time_s, step_s, count)
    np.testing.assert_allclose(found, means[0], rtol=1e-12)
    assert later == pytest.approx(means[0, 1] * np.exp(step_s / time_s))


def test_means_of_coloured_readings_are_whitened_with_a_share_above_one():
    """The innovations of their covariance, by its Cholesky factor."""
    step_s, size = 0.01, 200
    own, later = covariances_of_means(step_s * np.arange(size), 0.008, step_s, 2)
    colour = NoiseColour(share=later / own[0], correlation_time_s=0.008)
    assert colour.share > 1.0
    apart = np.abs(np.arange(size)[:, None] - np.arange(size))
    values = np.random.default_rng(6).normal(size=size)
    expected = solve_triangular(cholesky(own[apart] / own[0], lower=True), values, lower=True)
    np.testing.assert_allclose(colour.whitened(step_s * np.arange(size), values), expected, atol=1e-9)


def test_samples_too_close_for_means_leave_a_finite_residual():
    colour = NoiseColour(share=1.5, correlation_time_s=0.01)
    assert np.isfinite(colour.whitened(1e-4 * np.arange(50), np.ones(50))).all()

"""Noise that is correlated in time, and what is left of it once its past is known."""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular

from diagnosis.prepare.noise.noise_colour import NoiseColour

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

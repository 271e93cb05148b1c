"""Noise that is correlated in time, and what is left of it once its past is known."""

import numpy as np
import pytest
from scipy.linalg import cholesky, expm, solve_triangular

from diagnosis.prepare.noise.noise_colour import ColouredPart, NoiseColour, covariances_of_means

HALF = NoiseColour.of(share=0.6, correlation_time_s=0.05)
ALL = NoiseColour.of(share=1.0, correlation_time_s=0.05)
SWINGING = NoiseColour(
    parts=(
        ColouredPart(share=0.4, correlation_time_s=0.08, frequency_hz=7.0),
        ColouredPart(share=0.3, correlation_time_s=0.2),
        ColouredPart(share=0.2, correlation_time_s=0.01),
    )
)


def uneven(size=300, seed=1):
    return np.cumsum(np.random.default_rng(seed).uniform(0.004, 0.03, size))


def covariance(colour, time_s):
    apart = np.abs(time_s[:, None] - time_s)
    coloured = sum(part.share * part.covariances(apart) for part in colour.parts)
    return coloured + (1 - colour.share) * np.eye(time_s.size)


@pytest.mark.parametrize("colour", [HALF, ALL, SWINGING])
def test_whitening_is_the_inverse_root_of_the_covariance_at_any_times(colour):
    """The Cholesky factor is the one lower triangular root: the Kalman filter applies its inverse."""
    time_s = uneven()
    values = np.random.default_rng(2).normal(size=(time_s.size, 3))
    root = cholesky(covariance(colour, time_s), lower=True)
    expected = solve_triangular(root, values, lower=True)
    np.testing.assert_allclose(colour.whitened(time_s, values), expected, atol=1e-10)
    np.testing.assert_allclose(colour.whitened(time_s, values[:, 1]), expected[:, 1], atol=1e-10)
    assert colour.uncertainty(time_s) == pytest.approx(2 * np.log(np.diag(root)).sum())


@pytest.mark.parametrize("colour", [HALF, SWINGING])
def test_what_was_whitened_can_be_restored(colour):
    time_s = uneven()
    values = np.random.default_rng(3).normal(size=(time_s.size, 2))
    again = colour.restored(time_s, colour.whitened(time_s, values))
    np.testing.assert_allclose(again, values, atol=1e-12)


def test_density_is_the_sum_of_the_autocovariances():
    lags_s = 0.01 * np.arange(-2000, 2001)
    summed = 0.4 + 0.6 * np.exp(-np.abs(lags_s) / 0.05).sum()
    assert HALF.density(0.01) == pytest.approx(summed)
    swings = SWINGING.parts[0].covariances(lags_s)
    slow, fast = (np.exp(-np.abs(lags_s) / time).sum() for time in (0.2, 0.01))
    expected = 0.1 + 0.4 * swings.sum() + 0.3 * slow + 0.2 * fast
    assert SWINGING.density(0.01) == pytest.approx(expected)
    # Noise that forgets within a step is white.
    assert NoiseColour.of(share=1.0, correlation_time_s=1e-3).density(0.05) == pytest.approx(1.0)


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
    colour = NoiseColour.of(share=later / own[0], correlation_time_s=0.008)
    assert colour.share > 1.0
    apart = np.abs(np.arange(size)[:, None] - np.arange(size))
    values = np.random.default_rng(6).normal(size=size)
    expected = solve_triangular(cholesky(own[apart] / own[0], lower=True), values, lower=True)
    np.testing.assert_allclose(colour.whitened(step_s * np.arange(size), values), expected, atol=1e-9)


def test_samples_too_close_for_means_leave_a_finite_residual():
    colour = NoiseColour.of(share=1.5, correlation_time_s=0.01)
    assert np.isfinite(colour.whitened(1e-4 * np.arange(50), np.ones(50))).all()


def test_an_oscillator_has_the_autocovariances_of_its_equation():
    """By the matrix exponential of x'' + 2 x' / tau + (2 pi f)^2 x = 0 from x = 1 at rest."""
    part, lags_s = (
        ColouredPart(share=1.0, correlation_time_s=0.08, frequency_hz=7.0),
        0.01 * np.arange(20),
    )
    system = np.array([[0.0, 1.0], [-((2 * np.pi * 7.0) ** 2), -2 / 0.08]])
    expected = [expm(system * t)[0, 0] for t in lags_s]
    np.testing.assert_allclose(part.covariances(lags_s), expected, atol=1e-10)
    process = ColouredPart(share=1.0, correlation_time_s=0.08)
    np.testing.assert_allclose(process.covariances(-lags_s), np.exp(-lags_s / 0.08))

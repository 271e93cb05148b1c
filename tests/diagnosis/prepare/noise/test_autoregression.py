"""Noise that a digital filter shaped, and what is left of it once its past is known."""

import numpy as np
import pytest
from scipy.linalg import cholesky, solve_triangular
from scipy.signal import lfilter

from diagnosis.prepare.noise.autoregression import Autoregression, steps_of

TOLD, STEP_S = np.array([1.5, -0.8]), 0.01


def exact(size):
    """Autocovariances of y[i] = 1.5 y[i - 1] - 0.8 y[i - 2] + w[i], from its answer to a pulse."""
    pulse = lfilter([1], [1, *-TOLD], np.eye(1, 4000)[0])
    found = np.array([pulse[: pulse.size - lag] @ pulse[lag:] for lag in range(size)])
    return found / found[0]


def process(order=2):
    return Autoregression(autocovariances=tuple(exact(order + 1)), step_s=STEP_S)


def times(kept):
    return 3.0 + STEP_S * np.flatnonzero(np.random.default_rng(1).random(300) < kept)


@pytest.mark.parametrize("order", [2, 5])
def test_coefficients_and_density_are_those_of_the_process(order):
    found = process(order)
    np.testing.assert_allclose(found.coefficients, np.pad(TOLD, (0, order - 2)), atol=1e-9)
    assert found.density == pytest.approx(2 * exact(1000).sum() - 1)
    # The roots of z^2 - 1.5 z + 0.8 have a modulus of sqrt(0.8).
    assert process().correlation_time_s == pytest.approx(-STEP_S / np.log(np.sqrt(0.8)))
    assert process().share == pytest.approx(1 - 1 / _variance())


def _variance():
    pulse = lfilter([1], [1, *-TOLD], np.eye(1, 4000)[0])
    return float(pulse @ pulse)


@pytest.mark.parametrize("kept", [1.0, 0.97, 0.6])
def test_whitening_is_the_inverse_root_of_the_covariance_also_where_samples_are_missing(kept):
    time_s = times(kept)
    steps = np.rint(time_s / STEP_S).astype(int)
    root = cholesky(exact(301)[np.abs(steps[:, None] - steps)], lower=True)
    values = np.random.default_rng(2).normal(size=(time_s.size, 3))
    expected = solve_triangular(root, values, lower=True)
    np.testing.assert_allclose(process().whitened(time_s, values), expected, atol=1e-8)
    np.testing.assert_allclose(process().whitened(time_s, values[:, 1]), expected[:, 1], atol=1e-8)
    assert process().uncertainty(time_s) == pytest.approx(2 * np.log(np.diag(root)).sum())


def test_what_was_whitened_can_be_restored():
    values = np.random.default_rng(3).normal(size=(times(0.7).size, 2))
    again = process().restored(times(0.7), process().whitened(times(0.7), values))
    np.testing.assert_allclose(again, values, atol=1e-10)


@pytest.mark.parametrize("count", [1, 4])
def test_means_have_the_autoregression_of_their_covariances(count):
    means = process(6).of_so_many(count)
    lags = np.abs(np.arange(7 * count)[:, None] - np.arange(7 * count))
    blocks = exact(7 * count)[lags].reshape(7, count, 7, count).mean(axis=(1, 3))
    np.testing.assert_allclose(means.autocovariances, blocks[0] / blocks[0, 0], atol=1e-9)
    assert means.step_s == pytest.approx(count * STEP_S)


def test_time_stamps_that_scatter_or_have_few_digits_tell_the_steps():
    true = np.flatnonzero(np.random.default_rng(4).random(20_000) < 0.8)
    true = true - true[0]
    scattered = true + np.random.default_rng(5).uniform(-0.2, 0.2, true.size)
    np.testing.assert_array_equal(steps_of(STEP_S / 3 * true, round(STEP_S / 3, 5)), true)
    np.testing.assert_array_equal(steps_of(STEP_S * scattered, STEP_S), true)
    assert steps_of(np.array([1.0]), STEP_S).tolist() == [0]

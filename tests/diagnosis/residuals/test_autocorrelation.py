"""Memory of a residual, against closed forms."""

import numpy as np
import pytest
from scipy.signal import lfilter

from diagnosis.residuals.autocorrelation import autocorrelation

STEP = 0.01


def autoregressive(phi, size=20_000, seed=0):
    """Unit variance; correlation phi^k at lag k."""
    shaken = np.random.default_rng(seed).normal(size=size + 1000)
    return lfilter([np.sqrt(1 - phi**2)], [1, -phi], shaken)[1000:]


@pytest.mark.parametrize("phi", [-0.5, 0.5, 0.9])
def test_the_memory_of_an_autoregressive_residual_is_its_closed_form(phi):
    found = autocorrelation([autoregressive(phi, seed=s) for s in range(5)], STEP)
    exact = STEP * (1 + phi) / (1 - phi)
    # Lag 1 is good to sqrt((1 - phi^2) / N); the integral to sqrt(2 (2 M + 1) / N) with its window M of
    # five integral times, 6 % at phi = 0.9; it is never below one step.
    assert found.lag_one_correlation == pytest.approx(phi, abs=4 * np.sqrt((1 - phi**2) / 100_000))
    assert found.integral_s == pytest.approx(max(exact, STEP), rel=0.2)


def test_white_noise_stays_in_its_band_and_remembers_nothing():
    found = autocorrelation([autoregressive(0.0, seed=s) for s in range(5)], STEP)
    # The longest lag is 10 s: 1000 steps, which five trials of 20 000 samples have 95 000 times.
    assert found.white_limit == pytest.approx(1.96 / np.sqrt(95_000), rel=1e-3)
    beyond = [abs(rho) > found.white_limit for _, rho in found.by_lag_s]
    assert len(beyond) > 30
    assert np.mean(beyond) < 0.2  # 5 % are expected; more than 8 of 40 once in 10^4
    assert found.integral_s == pytest.approx(STEP, rel=0.1)


def test_a_shifted_copy_shows_at_its_lag():
    noise = autoregressive(0.0)
    found = dict(autocorrelation([noise + np.roll(noise, 10)], STEP).by_lag_s)
    lag = min(found, key=lambda s: abs(s - 0.1))
    assert lag == pytest.approx(0.1)
    assert found[lag] == pytest.approx(0.5, abs=0.03)


def test_an_offset_is_remembered_for_longer_than_can_be_told():
    found = autocorrelation([np.full(500, 3.0)], STEP)
    assert found.lag_one_correlation == pytest.approx(1.0)
    assert found.integral_s is None


def test_missing_samples_do_not_shorten_the_memory():
    gappy = autoregressive(0.9, size=60_000)
    gappy[np.random.default_rng(1).random(gappy.size) < 0.4] = np.nan
    assert autocorrelation([gappy], STEP).lag_one_correlation == pytest.approx(0.9, abs=0.03)


def test_few_pairs_widen_the_band():
    few = autoregressive(0.0, size=3000)
    few[np.random.default_rng(2).random(few.size) < 0.9] = np.nan
    found = autocorrelation([few], STEP)
    # A hundredth of 3000 samples, less a quarter at the longest lag, are pairs.
    assert found.white_limit > 1.96 / np.sqrt(30)
    assert np.mean([abs(rho) > found.white_limit for _, rho in found.by_lag_s]) < 0.2


@pytest.mark.parametrize("values", [np.ones(5), np.zeros(100), np.full(100, np.nan)])
def test_where_there_is_no_residual_there_is_no_memory(values):
    assert autocorrelation([values], STEP) is None

"""Drift of a sensor, told from what is left of its readings."""

import numpy as np
import pytest
from scipy.linalg import solve

from diagnosis.prepare.noise import drift as module
from diagnosis.prepare.noise.drift import Drift
from diagnosis.prepare.noise.noise_colour import NoiseColour

TIME = np.linspace(3.0, 33.0, 3001)
DRIFT = Drift(size_sigma=2.0)
COLOUR = NoiseColour.of(share=0.6, correlation_time_s=0.05)


def cost(values, drift=DRIFT):
    return float(np.sum(drift.whitened(TIME, values) ** 2))


def test_white_noise_and_a_walk_become_white():
    """Means of 25 samples, scaled by 5, have the rms of white noise: 1 within 3 / sqrt(2 * 120 * 20).

    The cosines of a walk that ends 2 sigma off on average have the amplitudes 2 sqrt(2) / (pi k).
    """
    rng, drift = np.random.default_rng(0), Drift(size_sigma=2.0 * np.sqrt(2.0) / np.pi)
    left = []
    for _ in range(20):
        walk = 2.0 * np.cumsum(rng.normal(size=TIME.size)) / np.sqrt(TIME.size)
        left.append(drift.whitened(TIME, rng.normal(size=TIME.size) + walk))
    blocks = np.concatenate([x[:3000].reshape(-1, 25).mean(axis=1) for x in left])
    assert 5 * np.sqrt(np.mean(blocks**2)) == pytest.approx(1.0, abs=0.07)


def test_a_line_of_the_size_of_a_drift_costs_nothing_and_a_larger_constant_does():
    line = 2.0 * (TIME - TIME[0]) / 30.0
    assert cost(line) < 2.0
    constant = np.full(TIME.size, 60.0)
    # (a / 3 D)^2 = 100, less what line and waves take of it.
    assert 30 < cost(constant) <= 100


def test_a_sensor_that_is_zeroed_before_a_trial_has_no_constant_of_its_own():
    """The free one takes a constant of 2 sigma for 2 / 6 of one standard deviation."""
    zeroed, constant = Drift(size_sigma=2.0, zeroed=True), np.full(TIME.size, 2.0)
    assert cost(constant, zeroed) > 20 * cost(constant)
    assert cost(2.0 * (TIME - TIME[0]) / 30.0, zeroed) < 2.0


def test_faster_motion_stays():
    wave = np.sin(2 * np.pi * TIME / 0.2)
    assert np.std(DRIFT.whitened(TIME, wave)) > 0.99 * np.std(wave)


def test_no_drift_changes_nothing():
    wave = np.sin(TIME)
    np.testing.assert_allclose(Drift(size_sigma=1e-9).whitened(TIME, wave), wave, atol=1e-9)


@pytest.mark.parametrize("drift", [DRIFT, Drift(size_sigma=0.5, zeroed=True, colour=COLOUR)])
def test_what_was_whitened_can_be_restored(drift):
    values = np.random.default_rng(3).normal(size=(TIME.size, 2))
    again = drift.restored(TIME, drift.whitened(TIME, values))
    np.testing.assert_allclose(again, values, atol=1e-9)
    np.testing.assert_allclose(drift.whitened(TIME, values[:, 0]), drift.whitened(TIME, values)[:, 0])


def test_cost_and_uncertainty_are_those_of_the_covariance_of_coloured_noise_and_drift():
    """-2 log(likelihood) = r' C^-1 r + log det C, with C of both, from its definition."""
    time_s, values = TIME[::10], np.random.default_rng(4).normal(size=301)
    drift = Drift(size_sigma=1.5, zeroed=True, colour=COLOUR)
    share = (time_s - time_s[0]) / (time_s[-1] - time_s[0])
    k = np.arange(1, 81)
    shapes = 1.5 * np.column_stack([share, (np.cos(np.pi * share[:, None] * k) - 1) / k])
    apart = np.abs(time_s[:, None] - time_s)
    coloured = 0.6 * np.exp(-apart / 0.05) + 0.4 * np.eye(time_s.size)
    both = coloured + shapes @ shapes.T
    left = drift.whitened(time_s, COLOUR.whitened(time_s, values))
    assert np.sum(left**2) == pytest.approx(values @ solve(both, values, assume_a="pos"))
    found = drift.uncertainty(time_s) + COLOUR.uncertainty(time_s)
    assert found == pytest.approx(np.linalg.slogdet(both)[1])


def test_the_likeliest_drift_follows_a_line_across_missing_readings():
    kept = (TIME < 10) | (TIME > 14)
    line = 0.1 * (TIME - 3)
    drift = DRIFT.likeliest(TIME, np.where(kept, line, np.nan))
    np.testing.assert_allclose(drift, line, atol=0.15)
    assert np.isfinite(drift).all()


def test_the_start_of_a_drift_is_told_in_its_standard_deviations():
    rng = np.random.default_rng(5)
    line = 0.1 * (TIME - 3) + rng.normal(size=TIME.size)
    assert abs(DRIFT.start(TIME, line)) < 3.0
    assert DRIFT.start(TIME, line + 3.0) > 5.0
    assert Drift(size_sigma=2.0, zeroed=True).start(TIME, line + 3.0) == 0.0


@pytest.mark.parametrize("zeroed", [False, True])
def test_directions_are_those_of_a_singular_value_decomposition(zeroed):
    """Squares over eight decades, to rounding of their sums, and directions at right angles."""
    time = np.sort(np.random.default_rng(2).uniform(0.0, 40.0, 4000))
    drift = Drift(size_sigma=5.0, zeroed=zeroed)
    directions, squares = module._directions(drift, time.tobytes())
    lengths = np.linalg.svd(module._shapes(time, drift), compute_uv=False)
    np.testing.assert_allclose(np.sort(squares)[::-1], lengths**2, rtol=1e-6)
    np.testing.assert_allclose(directions.T @ directions, np.eye(squares.size), atol=1e-6)

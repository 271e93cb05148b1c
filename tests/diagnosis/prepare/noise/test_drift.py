"""Drift of the torque sensor, told from what is left of its readings."""

import numpy as np
import pytest

from diagnosis.criteria import DRIFT_SIZE_SIGMA
from diagnosis.prepare.noise.drift import drift_whitening, likeliest_drift

TIME = np.linspace(3.0, 33.0, 3001)
ALL = np.ones(TIME.size, bool)


def without(values, kept=ALL, size=DRIFT_SIZE_SIGMA):
    basis = drift_whitening(TIME, kept, size)
    return values[kept] - basis @ (basis.T @ values[kept])


def test_white_noise_and_a_walk_become_white():
    """Means of 25 samples, scaled by 5, have the rms of white noise: 1 within 3 / sqrt(2 * 120 * 20)."""
    rng = np.random.default_rng(0)
    left = []
    for _ in range(20):
        walk = np.cumsum(rng.normal(size=TIME.size))
        left.append(without(rng.normal(size=TIME.size) + 3.0 * walk / np.ptp(walk)))
    blocks = np.concatenate([x[:3000].reshape(-1, 25).mean(axis=1) for x in left])
    assert 5 * np.sqrt(np.mean(blocks**2)) == pytest.approx(1.0, abs=0.07)


def test_a_line_of_the_size_of_a_drift_costs_nothing_and_a_larger_constant_does():
    line = 2.0 * (TIME - TIME[0]) / 30.0
    assert np.sum(without(line) ** 2) < 2.0
    constant = np.full(TIME.size, 60.0)
    # (a / 3 D)^2 = 100, less what line and waves take of it.
    assert 30 < np.sum(without(constant) ** 2) <= 100


def test_faster_motion_stays():
    wave = np.sin(2 * np.pi * TIME / 0.7)
    assert np.std(without(wave)) > 0.99 * np.std(wave)


def test_no_drift_changes_nothing():
    wave = np.sin(TIME)
    np.testing.assert_allclose(without(wave, size=1e-9), wave, atol=1e-9)


def test_the_likeliest_drift_follows_a_line_across_missing_readings():
    kept = (TIME < 10) | (TIME > 14)
    line = 0.1 * (TIME - 3)
    drift = likeliest_drift(TIME, np.where(kept, line, np.nan), DRIFT_SIZE_SIGMA)
    np.testing.assert_allclose(drift, line, atol=0.1)
    assert np.isfinite(drift).all()

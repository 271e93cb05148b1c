"""Noise that grows with rate or torque, told by differences of what an explanation leaves."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import RIG, prepared, trial, turns

from diagnosis.prepare.noise.growing_noise import growing_noise
from diagnosis.prepare.prepared_log import PreparedLog

SECONDS = 40.0
SMALL = 0.7  # of the noise that is grown


@pytest.fixture(scope="module")
def turning():
    """A base that swings ever faster."""
    time = np.arange(0, SECONDS, 0.01)
    return prepared(trial(30 * np.sin(0.05 * time**2)))


def told(one, noise):
    return growing_noise(PreparedLog(rig=RIG, trials=(one,)), [(one, noise)])


def normal(size, seed=3):
    return np.random.default_rng(seed).normal(size=size)


def grown(one, factor):
    """Standard deviation of noise that is so many times as large at the largest rate."""
    rate = np.abs(np.gradient(one.base_motion_deg, one.time_s))
    return 1 + (factor - 1) * rate / rate.max()


@pytest.mark.parametrize("factor", [2.0, 4.0])
def test_noise_that_grows_with_the_rate_is_measured(turning, factor):
    """Of M normal values the deviation scatters by 1 / sqrt(2 M): 2.5 % of 800, thrice for a slope."""
    size = grown(turning, factor)
    found = told(turning, SMALL * size * normal(size.size))
    assert found.grows_with == "rate"
    assert found.factor == pytest.approx(factor, rel=3 * 0.075)
    np.testing.assert_allclose(found.noise_ratio * found.sizes(turning), SMALL * size, rtol=0.2)
    assert np.mean(found.sizes(turning) ** 2) == pytest.approx(1.0)


def test_noise_that_grows_with_the_torque_is_measured(turning):
    torque = 0.5 * np.cos(0.3 * turning.time_s)
    one = replace(turning, readings={**turning.readings, "base_torque_n_mm": torque})
    found = told(one, (1 + 4 * np.abs(torque)) * normal(torque.size))
    assert found.grows_with == "torque"
    assert found.factor == pytest.approx(3.0, rel=3 * 0.075)


@pytest.mark.parametrize("seed", range(5))
def test_noise_of_one_size_does_not_grow(turning, seed):
    assert told(turning, normal(turning.time_s.size, seed)) is None


@pytest.mark.parametrize("seed", range(5))
def test_heavy_tails_do_not_grow(turning, seed):
    noise = np.random.default_rng(seed).standard_t(3, size=turning.time_s.size)
    assert told(turning, noise) is None


def test_what_swings_faster_than_noise_where_the_base_turns_fast_is_no_noise(turning):
    """Off in the same way over several samples."""
    size = grown(turning, 4.0)
    swing = size * np.sin(2 * np.pi * 6.0 * turning.time_s)
    assert told(turning, swing + 0.3 * normal(size.size)) is None


def test_of_a_base_that_rests_nothing_grows():
    one = prepared(trial(np.zeros(turns().size)))
    assert told(one, normal(one.time_s.size)) is None


def test_readings_that_are_missing_are_left_out(turning):
    noise = grown(turning, 4.0) * normal(turning.time_s.size)
    noise[::7] = np.nan
    assert told(turning, noise).factor == pytest.approx(4.0, rel=3 * 0.08)

"""The motion of the base between rare samples."""

import numpy as np
import pytest

from diagnosis.prepare.motion.between_samples import between_samples

STEP_S = 0.05


def missed(motion, step=STEP_S):
    """The largest error of the motion between its samples, and that of straight lines, deg."""
    at = np.arange(0, 6, step)
    time, angle = between_samples(at, motion(at))
    straight = np.interp(time, at, motion(at))
    return np.abs(angle - motion(time)).max(), np.abs(straight - motion(time)).max()


def test_a_smooth_motion_is_followed_far_closer_than_by_lines():
    curve, lines = missed(lambda t: 60 * np.sin(2 * np.pi * 0.5 * t))
    # Lines are off by 60 (2 pi 0.5)^2 0.05^2 / 8 = 0.19 deg; Akima's curve is of a higher order.
    assert lines == pytest.approx(0.185, rel=0.1)
    assert curve < 0.15 * lines


def test_a_corner_between_two_samples_is_where_the_lines_cross():
    curve, lines = missed(lambda t: np.interp(t, [0, 2.02, 3.53, 6], [0, 0, 150, 150]))
    assert lines > 1
    assert curve < 1e-9


def test_noise_makes_no_overshoot_at_a_corner_that_is_a_sample():
    """A motion that stops dead ends no farther than its samples do, noise of 0.01 deg or not."""
    at = np.arange(0, 2, 0.02)
    for seed in range(20):
        noise = np.random.default_rng(seed).normal(0, 0.01, at.size)
        read = np.minimum(68.0 * at, 68.0) + noise
        _, angle = between_samples(at, read)
        assert angle.max() <= read.max() + 0.02


def test_samples_are_met():
    at = np.arange(0, 3, STEP_S)
    read = np.random.default_rng(1).normal(0, 10, at.size)
    time, angle = between_samples(at, read)
    np.testing.assert_allclose(np.interp(at, time, angle), read, atol=1e-9)


@pytest.mark.parametrize("step", [0.01, 0.005])
def test_a_replay_that_is_twice_as_fine_as_the_samples_follows_the_motion(step):
    """At its middles, lines are off by 400 deg/s^2 step^2 / 8."""
    at = step * np.arange(100)
    time, angle = between_samples(at, 200.0 * at**2)
    np.testing.assert_allclose(time, 0.5 * step * np.arange(199), atol=1e-12)
    off = np.abs(angle - 200.0 * time**2)
    assert off[8:-8].max() < 0.02 * 400.0 * step**2 / 8


def test_too_few_samples_are_left_alone():
    at = 0.05 * np.arange(4)
    time, angle = between_samples(at, at**2)
    assert time is at
    np.testing.assert_array_equal(angle, at**2)


def test_it_stays_between_two_samples_unless_it_turns_there():
    """A base that comes to rest, and one that turns back between two samples."""
    at = np.arange(0, 2, STEP_S)
    noise = np.random.default_rng(4).normal(0, 0.005, at.size)
    read = np.maximum.accumulate(np.minimum(68.0 * at**1.1, 68.0) + noise)
    time, angle = between_samples(at, read)
    assert np.all(np.diff(angle) >= -1e-12)
    back = 10 - 200 * (at - 1.025) ** 2
    _, turned = between_samples(at, back)
    assert turned.max() > back.max() + 0.05  # the top is 0.125 deg above its samples
    assert time.size > at.size


@pytest.mark.parametrize("after_deg", [-1e-4, 0.0, 1e-4])
def test_a_fast_turn_that_has_ended_just_after_a_sample_does_not_reach_beyond_where_it_ends(after_deg):
    """Whichever way what is left of the noise goes at rest: dry friction would remember the reversal."""
    at = STEP_S * np.arange(40)
    read = np.minimum(230.0 * at, 106.2) + after_deg * np.maximum(at - 0.5, 0.0) / STEP_S
    _, angle = between_samples(at, read)
    assert angle.max() <= read.max() + 1e-9

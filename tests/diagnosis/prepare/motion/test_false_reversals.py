"""Reversals of the base that its noise makes up, and those that it makes."""

from itertools import pairwise

import numpy as np
import pytest
from diagnosis_fixtures import BASE, turns

from diagnosis.criteria.prepare import STANDSTILL_SAMPLES
from diagnosis.prepare.motion.base_smoothing import smooth_base
from diagnosis.prepare.motion.false_reversals import turning_points, without_false_reversals
from diagnosis.replay.sensing.bearing import stopped_at
from sim.discretisation import PRESLIDING_DEG

STEP_S = 0.01
ROUNDING = 1e-12  # of angles below 100 deg


def sine(hertz, size_deg):
    return size_deg * np.sin(2 * np.pi * hertz * np.arange(0, 12, STEP_S))


def too_high(angle, sigma, smooth):
    """By what share a bearing's friction comes out too high, in the mean of ten logs."""
    true, shares = stopped_at(angle, PRESLIDING_DEG), []
    for seed in range(10):
        read = angle + np.random.default_rng(seed).normal(0, sigma, angle.size)
        seen = stopped_at(smooth(STEP_S * np.arange(angle.size), read, sigma), PRESLIDING_DEG)
        shares.append(seen @ true / (seen @ seen) - 1)
    return float(np.mean(shares))


def windows_alone(time_s, read, sigma, monkeypatch):
    with monkeypatch.context() as patch:
        patch.setattr(
            "diagnosis.prepare.motion.base_smoothing.without_false_reversals", lambda motion, _: motion
        )
        return smooth_base(time_s, read, sigma)


@pytest.mark.parametrize("sigma", [BASE, 5 * BASE])
def test_friction_of_a_bearing_is_right_beside_a_noisy_encoder(sigma, monkeypatch):
    """A level is to be good to 0.5 %; without it, noise alone makes twice that and more."""
    assert abs(too_high(turns(), sigma, smooth_base)) < 0.005
    before = too_high(turns(), sigma, lambda *args: windows_alone(*args, monkeypatch))
    assert before > 0.01


@pytest.mark.parametrize(("hertz", "size_deg"), [(0.03, 30.0), (0.3, 20.0), (1.5, 5.0)])
def test_a_motion_that_turns_by_itself_keeps_its_reversals(hertz, size_deg, monkeypatch):
    """They are cut by no more than two sigma / sqrt(17) for a moment, 10 % of the presliding angle."""
    motion = sine(hertz, size_deg)
    before = too_high(motion, BASE, lambda *args: windows_alone(*args, monkeypatch))
    assert abs(too_high(motion, BASE, smooth_base) - before) < 0.003


def test_between_turning_points_the_motion_is_monotone():
    noisy = turns() + np.random.default_rng(1).normal(0, BASE / 3, turns().size)
    settled = without_false_reversals(noisy, BASE)
    ends = turning_points(noisy, BASE)
    for first, last in pairwise(ends):
        steps = np.diff(settled[first : last + 1])
        assert np.all(steps >= -ROUNDING) or np.all(steps <= ROUNDING)


def test_a_monotone_motion_is_no_farther_from_the_truth_than_before():
    """A projection onto a convex set that holds the truth."""
    true = np.linspace(0, 0.3, 2000)  # so slow that noise turns it back everywhere
    noisy = true + np.random.default_rng(2).normal(0, BASE / 5, true.size)
    settled = without_false_reversals(noisy, BASE)
    assert np.all(np.diff(settled) >= 0)
    assert np.linalg.norm(settled - true) < np.linalg.norm(noisy - true)


def test_a_rest_where_it_turns_is_at_its_mean():
    rest = np.random.default_rng(3).normal(0, BASE / 40, 400)  # a range of 0.15, below 4 / sqrt(400)
    motion = np.concatenate([np.linspace(-10, -1, 50), rest, np.linspace(-1, -10, 50)])
    settled = without_false_reversals(motion, BASE)
    np.testing.assert_allclose(settled[60:440], rest.mean(), atol=BASE / 40 / np.sqrt(400))
    assert np.ptp(settled[60:440]) == 0.0


def test_a_short_top_is_no_rest():
    top = np.concatenate(
        [np.linspace(-1, 0, 20), [0.0] * (STANDSTILL_SAMPLES - 2), np.linspace(0, -1, 20)]
    )
    np.testing.assert_array_equal(without_false_reversals(top, BASE), top)


def test_the_base_turns_where_it_swings_by_more_than_the_noise():
    motion = np.concatenate([np.linspace(0, 5, 50), np.linspace(4.9, 4.0, 10), np.linspace(4.1, 9, 50)])
    assert turning_points(motion, 0.9).tolist() == [0, 49, 59, motion.size - 1]
    assert turning_points(motion, 1.1).tolist() == [0, motion.size - 1]

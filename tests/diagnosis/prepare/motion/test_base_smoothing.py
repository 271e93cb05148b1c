"""The motion of the base behind its noisy readings."""

import numpy as np
import pytest
from diagnosis_fixtures import BASE, turns

from diagnosis.prepare.motion.base_smoothing import smooth_base

STEP_S = 0.01


def error(angle, seed):
    """What smoothing leaves of the encoder's noise."""
    noisy = angle + np.random.default_rng(seed).normal(0, BASE, angle.size)
    return smooth_base(STEP_S * np.arange(angle.size), noisy, BASE) - angle


def test_base_noise_is_averaged_out_where_the_base_holds_and_turns_are_kept():
    missed = error(turns(), 1)
    held = slice(700, 900)  # 0.1 s and more from every corner
    # The widest window before the next corner, about 100 samples, leaves a tenth of the noise if
    # it is a mean; lines and parabolas, which are weighed in, leave up to a fifth.
    assert np.sqrt(np.mean(missed[held] ** 2)) < BASE / 5
    # Windows agree with their samples within 3 sigma, so corners are missed by no more than that.
    assert np.abs(missed).max() < 4 * BASE


def test_a_motion_that_is_never_slow_is_left_alone():
    time = np.arange(0, 10, STEP_S)
    angle = 40 * np.sin(2 * np.pi * 1.5 * time) + 10 * np.sin(2 * np.pi * 3.1 * time)
    assert np.sqrt(np.mean(error(angle, 2) ** 2)) < BASE


def test_an_encoder_without_noise_is_taken_as_it_is():
    angle = turns()
    assert smooth_base(STEP_S * np.arange(angle.size), angle, 0.0) is angle


@pytest.mark.parametrize("late_s", [0.0, 0.0045], ids=["jitter", "first interval shorter"])
def test_a_fast_turn_read_at_uneven_times_is_not_cut_short(late_s):
    """A straight line between samples is off by a h^2 / 8 = 0.04 deg at its top; noise is 0.004 deg."""
    rng = np.random.default_rng(3)
    time = np.arange(0, 10, STEP_S)
    time[1:] -= late_s if late_s else rng.uniform(0, 0.3 * STEP_S, time.size - 1)
    angle = 30 * np.sin(2 * np.pi * 1.5 * time)
    noisy = angle + rng.normal(0, BASE, angle.size)
    missed = smooth_base(time, noisy, BASE) - angle
    assert np.sqrt(np.mean(missed[1:-1] ** 2)) < 1.5 * BASE

"""Rests and reversals of a base that is known to rest and turn back."""

import numpy as np
import pytest
from analytic_log import TURNS

from diagnosis.lab_files.motion import motion_of

WINDOW_S = 0.3  # of the slope: a rest is seen to within half of it at either end


@pytest.mark.parametrize("scale", [1.0, 0.0174533, 182.0])
def test_rests_are_found_in_any_unit(scale):
    """The base rests from 0 to 1 s, from 2 to 6 s and from 7 s to the end."""
    motion = motion_of(TURNS["time_s"].to_numpy(), scale * TURNS["base_angle_deg"].to_numpy())
    assert len(motion.rests_s) == 3
    for found, known in zip(motion.rests_s, ((0, 1), (2, 6), (7, 12)), strict=True):
        assert found == pytest.approx(known, abs=WINDOW_S / 2 + 0.05)


def test_a_slow_turn_is_no_rest():
    """0.5 deg/s for 10 s, three times what four sigma of a slope are: 0.17 deg/s."""
    time = np.arange(0, 10, 0.01)
    noise = np.random.default_rng(1).normal(0, 0.02, time.size)
    assert motion_of(time, 0.5 * time + noise).rests_s == ()


def test_a_sine_has_reversals_and_no_rest():
    time = np.arange(0, 10.2, 0.01)
    angle = 30 * np.sin(2 * np.pi * 0.5 * time)
    motion = motion_of(time, angle + np.random.default_rng(2).normal(0, 0.02, time.size))
    assert motion.rests_s == ()
    assert time[list(motion.reversals)] == pytest.approx(np.arange(0.5, 10, 1.0), abs=0.05)


def test_noise_alone_turns_back_nowhere():
    time = np.arange(0, 10, 0.01)
    motion = motion_of(time, np.random.default_rng(3).normal(0, 1, time.size))
    assert motion.reversals == ()
    assert len(motion.rests_s) == 1


def test_the_first_rest_is_that_of_a_trial_that_starts_at_rest():
    time, angle = TURNS["time_s"].to_numpy(), TURNS["base_angle_deg"].to_numpy()
    assert motion_of(time, angle).in_first_rest(time)[:80].all()
    later = time > 1.5
    assert not motion_of(time[later], angle[later]).in_first_rest(time).any()

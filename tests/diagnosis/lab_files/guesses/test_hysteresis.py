"""Loops of known stiffness, play and level."""

import numpy as np
import pytest
from loops import torque_of, turns_and_holds

from diagnosis.lab_files.guesses.hysteresis import branches_of, kept_torques, loop_shape
from diagnosis.lab_files.motion import motion_of

NOISE = 0.1
TIME, ANGLE = turns_and_holds(times=8)


def shape_of(torque, angle=ANGLE, noise=NOISE):
    rng = np.random.default_rng(4)
    angle = angle + rng.normal(0, 0.005, angle.size)
    torque = torque + rng.normal(0, noise, angle.size)
    motion = motion_of(TIME, angle)
    return loop_shape(branches_of(motion, angle, torque), kept_torques(motion, angle, torque), noise)


@pytest.mark.parametrize("stiffness", [2.0, 8.0])
@pytest.mark.parametrize("play", [0.0, 1.0, 5.0])
def test_stiffness_play_and_level_are_those_of_the_loop(stiffness, play):
    """Level 20 and noise 0.1: a line over a fifth of 40 has at least 5 samples at 20 deg/s and k = 8,
    so that its slope is good to 0.1 / 8 / 0.35 = 4 %, and its crossing to 0.1 / 8 deg times 3; the
    samples on either side of it bend it by half a step, 0.1 deg."""
    shape = shape_of(torque_of(ANGLE, stiffness=stiffness, play=play, level=20.0) + 1.5)
    assert shape.stiffness.value == pytest.approx(stiffness, rel=0.06)
    assert shape.play.value == pytest.approx(play, abs=0.3)
    assert shape.level.value == pytest.approx(20, rel=0.01)
    assert shape.middle.value == pytest.approx(1.5, abs=0.1)
    assert shape.kept.value == pytest.approx(20, abs=1.6)
    assert shape.level.reversals == 7
    assert shape.rates_per_s == pytest.approx((20, 20), rel=0.05)


def test_viscous_torque_widens_loops_but_is_not_kept_at_rest():
    shape = shape_of(0.5 * np.gradient(ANGLE, TIME))
    assert shape.level.value == pytest.approx(10, rel=0.05)
    # The mean of half a second: 50 samples of noise 0.1.
    assert shape.kept.value == pytest.approx(0, abs=4 * NOISE / np.sqrt(50))


def test_a_spring_alone_and_noise_alone_have_no_loops():
    assert shape_of(0.3 * ANGLE).play.value in (None, pytest.approx(0, abs=1.0))
    assert shape_of(np.zeros(TIME.size)).level.value is None
    assert shape_of(np.zeros(TIME.size)).level.told("N mm") == "not seen"


def test_a_torque_against_the_turn_is_left_out():
    shape = shape_of(-torque_of(ANGLE, stiffness=4, play=0, level=20))
    assert shape.stiffness.value is None
    assert shape.level.value is None


def test_one_reversal_has_no_scatter_in_words():
    shape = loop_shape([], [1.0], NOISE)
    assert shape.kept.told("N mm") == "1 N mm (once)"
    assert "±" in loop_shape([], [1.0, 1.2], NOISE).kept.told("N mm")

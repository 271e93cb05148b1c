"""How often in a turn a reading ripples."""

from dataclasses import replace

import numpy as np
import pytest
from free_forms import covered

from diagnosis.freeform.templates.ripple import MOST_WAVES, waves_in_a_turn
from diagnosis.replay.variables import Variable

ANGLE = np.interp(np.arange(0, 20, 0.01), [0, 2, 16, 20], [0, 0, 800, 800])
NOISE = np.random.default_rng(6).normal(0, 0.02, ANGLE.size)


def ripple(waves, phase=0.4):
    return 0.05 * np.sin(waves * np.radians(ANGLE) + phase)


@pytest.mark.parametrize("waves", [2, 7, 24, MOST_WAVES])
def test_waves_over_the_angle_of_the_base_are_counted_in_noise(waves):
    ranges = covered(ANGLE, torque=ripple(waves) + NOISE)
    assert waves_in_a_turn(ranges, "base_torque_n_mm", Variable.BASE_ANGLE) == waves


def test_waves_over_the_angle_of_the_tip_are_those_of_the_nominal_tip():
    """At half the angle, as many waves in a turn of the tip are twice as many of the base."""
    tip = 0.5 * ANGLE
    ranges = covered(ANGLE, tip=tip + ripple(5), seen=(tip, np.zeros(ANGLE.size)))
    assert waves_in_a_turn(ranges, "tip_angle_deg", Variable.TIP_ANGLE) == 10


def test_an_offset_and_missing_samples_are_no_ripple():
    torque = 3.0 + ripple(9) + NOISE
    torque[300:400] = np.nan
    ranges = covered(ANGLE, torque=torque)
    assert waves_in_a_turn(ranges, "base_torque_n_mm", Variable.BASE_ANGLE) == 9


def test_what_does_not_ripple_at_all_has_the_fewest_waves():
    ranges = covered(ANGLE, torque=NOISE, seen=(NOISE, NOISE))
    left = {"base_torque_n_mm": (np.zeros(ANGLE.size),)}
    assert waves_in_a_turn(replace(ranges, left=left), "base_torque_n_mm", Variable.BASE_ANGLE) == 2


def test_the_larger_of_two_ripples_is_told():
    ranges = covered(ANGLE, torque=ripple(9) + 2 * ripple(31))
    assert waves_in_a_turn(ranges, "base_torque_n_mm", Variable.BASE_ANGLE) == 31

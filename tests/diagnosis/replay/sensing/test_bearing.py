"""Dry friction of a bearing against the closed form of a stop operator."""

import numpy as np
import pytest

from diagnosis.replay.sensing.bearing import bearing_torque_n_mm
from sim.discretisation import PRESLIDING_DEG


def test_it_sticks_up_to_the_presliding_angle_and_then_slides_at_its_level():
    shaft = np.linspace(0.0, 0.5, 51)
    expected = 2.0 * np.minimum(shaft / 0.1, 1.0)
    np.testing.assert_allclose(bearing_torque_n_mm(shaft, 2.0), expected, atol=1e-12)
    assert PRESLIDING_DEG == 0.1


def test_a_reversal_takes_twice_the_presliding_angle_and_a_hold_keeps_the_torque():
    shaft = np.concatenate([np.linspace(0, 30, 301), np.full(50, 30.0), 30 - np.linspace(0, 0.3, 31)])
    torque = bearing_torque_n_mm(shaft, 0.5)
    np.testing.assert_allclose(torque[300:351], 0.5, atol=1e-9)
    back = 30 - shaft[351:]
    np.testing.assert_allclose(torque[351:], 0.5 * np.maximum(1 - back / 0.1, -1.0), atol=1e-9)


def test_a_bearing_may_give_by_another_angle():
    shaft = np.linspace(0.0, 0.5, 51)
    torque = bearing_torque_n_mm(shaft, 2.0, 0.25)
    np.testing.assert_allclose(torque, 2.0 * np.minimum(shaft / 0.25, 1.0), atol=1e-12)


def test_less_motion_than_the_presliding_angle_is_a_spring():
    """Negative control: nothing slides, and no work is lost."""
    shaft = 0.09 * np.sin(np.linspace(0, 4 * np.pi, 401))
    torque = bearing_torque_n_mm(shaft, 0.5)
    np.testing.assert_allclose(torque, 5.0 * shaft, atol=1e-12)
    assert np.trapezoid(torque, shaft) == pytest.approx(0.0, abs=1e-12)

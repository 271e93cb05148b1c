"""How the base turns."""

import math

import numpy as np
import pytest

from studies.published.experiments.base_turn import BaseTurn, BaseTurnShape


def test_a_ramp_is_half_done_at_half_its_time_and_then_stays():
    assert BaseTurn(time_s=0.3).angle_deg(np.array([0.15, 1.0])) == pytest.approx([45.0, 90.0])


def test_a_servo_is_critically_damped():
    servo = BaseTurn(shape=BaseTurnShape.SERVO, time_s=0.11)
    # 1 - 2 / e after one time constant, and never beyond the reference.
    assert servo.angle_deg(np.array([0.11]))[0] == pytest.approx(90 * (1 - 2 / math.e))
    assert servo.angle_deg(np.linspace(0, 3, 100)).max() <= 90.0

"""A servo against the closed form of a damped oscillator."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from models.errors import InvalidValue
from models.servo import Servo


@pytest.mark.parametrize("damping_ratio", [0.3, 0.7])
def test_a_step_of_the_command_gives_the_step_response_of_a_damped_oscillator(damping_ratio):
    servo, step, n = Servo(natural_frequency_hz=10, damping_ratio=damping_ratio), 0.002, 100
    state, angles = np.zeros(2), []
    for _ in range(n):
        state = servo.after(state, 90.0, step)
        angles.append(state[0])
    t, w, d = step * np.arange(1, n + 1), 2 * math.pi * 10, damping_ratio
    damped = w * math.sqrt(1 - d**2)
    swing = np.cos(damped * t) + d * w / damped * np.sin(damped * t)
    assert angles == pytest.approx(90 * (1 - np.exp(-d * w * t) * swing), abs=1e-9)


def test_an_overdamped_servo_moves_as_its_differential_equation():
    servo = Servo(natural_frequency_hz=5, damping_ratio=1.5)
    w = servo.rate_rad_s
    truth = solve_ivp(
        lambda t, x: [x[1], w**2 * (1 - x[0]) - 3 * w * x[1]], (0, 0.05), [0.2, -1.0], rtol=1e-10
    )
    assert servo.after(np.array([0.2, -1.0]), 1.0, 0.05) == pytest.approx(truth.y[:, -1], rel=1e-6)


def test_behind_a_slow_ramp_the_shaft_lags_by_two_damping_ratios_over_the_natural_frequency():
    servo, step = Servo(natural_frequency_hz=10), 1e-4
    state = np.zeros(2)
    for i in range(10_000):
        state = servo.after(state, 50.0 * (i + 0.5) * step, step)
    # 1 s is 44 time constants; the held command is a ramp on average.
    assert state[0] == pytest.approx(50.0 * (1.0 - servo.lag_s), abs=1e-4)


@pytest.mark.parametrize("field", ["natural_frequency_hz", "damping_ratio"])
def test_an_impossible_servo_is_refused_by_the_name_of_its_field(field):
    with pytest.raises(InvalidValue, match=field):
        Servo(**({"natural_frequency_hz": 1.0} | {field: 0.0}))

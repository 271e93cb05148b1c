"""The digital servo on a rotor: its dynamics, its errors, its limit, and what it refuses."""

import math

import numpy as np
import pytest
from scipy import signal

from models import units
from models.drive import Drive
from models.errors import InvalidValue
from models.servo import Servo
from sim.loop.hardware import LoopHardware, Sensors
from sim.loop.servo_loop import ServoLoop

J = 2.5e-5
MOTOR = Drive(kind="torque", rotor_inertia_kg_m2=J)
HARDWARE = LoopHardware(servo=Servo(natural_frequency_hz=10))
W = HARDWARE.servo.rate_rad_s


def turned(hardware=HARDWARE, drive=MOTOR, *, load_n_mm=0.0, step_s=1e-4, seconds=0.5, command=90.0):
    """Angles of a rotor under a constant load, by exact motion between steps: (N,) deg, torques."""
    loop = ServoLoop(hardware, drive, step_s=step_s)
    shown = load_n_mm + hardware.sensors.torque_bias_n_mm
    angle = rate = 0.0
    angles, torques = [], []
    for _ in range(round(seconds / step_s)):
        torque = loop.motor_torque_n_mm(command, angle, shown)
        acceleration = (torque - load_n_mm) * units.N_MM / J / units.DEG
        angle += step_s * rate + 0.5 * step_s**2 * acceleration
        rate += step_s * acceleration
        angles.append(angle)
        torques.append(torque)
    return np.array(angles), np.array(torques)


def test_a_rotor_moves_as_the_second_order_system_whatever_torque_the_needle_takes():
    angles, _ = turned(load_n_mm=3.0)
    _, response = signal.step(([W**2], [1, 1.4 * W, W**2]), T=1e-4 * np.arange(1, angles.size + 1))
    # The command is held for a step and the rate is known half a step late: w h = 0.6 % of it.
    assert np.abs(angles - 90 * response).max() < 90 * 2 * W * 1e-4
    assert angles[-1] == pytest.approx(90.0, abs=1e-3)


def test_a_biased_torque_sensor_leaves_the_error_of_the_docstring():
    biased = HARDWARE.but(sensors=Sensors(torque_bias_n_mm=0.1))
    angles, _ = turned(biased, command=0.0)
    predicted = math.degrees((10 / 9 + 4 * 0.7 / 3) * 0.1 * units.N_MM / (J * W**2))
    assert angles[-1] == pytest.approx(predicted, rel=3 * W * 1e-4 * 2)


def test_an_encoder_of_coarse_counts_keeps_the_shaft_within_a_count():
    coarse = HARDWARE.but(sensors=Sensors(base_step_deg=0.36))
    angles, _ = turned(coarse, step_s=2e-3, seconds=2.0)
    assert np.abs(angles[-500:] - 90).max() < 0.36


def test_the_motor_gives_no_more_than_its_limit_and_the_shaft_arrives_all_the_same():
    angles, torques = turned(drive=MOTOR.but(torque_limit_n_mm=20.0), load_n_mm=3.0, seconds=2.0)
    assert np.abs(torques).max() == 20.0
    assert angles[-1] == pytest.approx(90.0, abs=0.01)
    # With 17 N mm left, half of the way takes sqrt(90 deg J / 17 N mm).
    least = math.sqrt(math.radians(90) * J / 17e-3)
    assert (np.flatnonzero(angles > 45)[0] + 1) * 1e-4 > least


@pytest.mark.parametrize(
    ("hardware", "drive", "step_s", "field"),
    [
        (LoopHardware(), MOTOR, 1e-3, "hardware.servo"),
        (HARDWARE, Drive(kind="torque"), 1e-3, "rotor_inertia"),
        (HARDWARE, MOTOR, 0.01, "step_s"),
    ],
)
def test_a_servo_that_cannot_work_is_refused(hardware, drive, step_s, field):
    with pytest.raises(InvalidValue, match=field):
        ServoLoop(hardware, drive, step_s=step_s)

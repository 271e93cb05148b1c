"""The drive shaft behind latency and servo."""

import pytest
from scipy import signal

from models.servo import Servo
from sim.loop.hardware import LoopHardware
from sim.loop.shaft import CommandedShaft

STEP_S = 0.002


def test_an_ideal_shaft_is_where_it_was_commanded():
    shaft = CommandedShaft(LoopHardware(), step_s=STEP_S)
    assert [shaft.follow(x) for x in (1.0, 5.0, -2.0)] == [1.0, 5.0, -2.0]


def test_a_command_arrives_after_the_latency_and_before_it_the_shaft_stands():
    shaft = CommandedShaft(LoopHardware(command_latency_s=0.004), step_s=STEP_S, start_deg=3.0)
    assert [shaft.follow(x) for x in (10.0, 20.0, 30.0, 40.0)] == [3.0, 3.0, 10.0, 20.0]


def test_behind_latency_and_servo_a_step_is_the_textbook_step_response_later():
    hardware = LoopHardware(command_latency_s=0.01, servo=Servo(natural_frequency_hz=10))
    shaft = CommandedShaft(hardware, step_s=STEP_S)
    angles = [shaft.follow(90.0) for _ in range(60)]
    w = hardware.servo.rate_rad_s
    times = [STEP_S * i for i in range(56)]
    _, response = signal.step(([w**2], [1, 2 * 0.7 * w, w**2]), T=times)
    assert angles[4:] == pytest.approx(90 * response, abs=1e-6)
    assert angles[:5] == [0.0] * 5

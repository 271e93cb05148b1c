"""A step of the reference on one rig, and how the response is measured."""

import math
from dataclasses import replace

import numpy as np
import pytest

from controllers.limits import MotorLimits
from models.drive import Drive
from models.materials import tissue_named
from models.needle import NITINOL
from models.servo import Servo
from models.tissue import Tissue
from sim.kernel import memory_map
from sim.loop.hardware import LoopHardware
from studies.control.step_response import (
    DAMPING,
    ControlPlant,
    final_error_deg,
    largest_shear_stress_mpa,
    response_metrics,
    step_on,
    turn,
)
from studies.control.tip_controllers import ControllerDesign

BETA = DAMPING
VISCOUS = tissue_named("viscous-plastisol")


def test_the_friction_aware_controller_unwinds_part_of_what_it_wound():
    dry = Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=0.006)
    controlled = turn("friction_aware", depth_cm=10, free_mm=50, tissue=dry, noise=None, hold_s=4.0)
    base, torque = controlled.run.inputs.drive, controlled.run.base_torque_n_mm
    wound = (controlled.run.time_s > 1.2) & (controlled.run.time_s < 1.4)
    assert abs(90 - controlled.run.tip_deg[-1]) < 1.0
    assert torque[-1] < 0.6 * torque[wound].max()
    assert base[-1] > 92


def test_a_retraction_that_a_controller_asks_for_moves_the_needle():
    """Beyond its torque limit in much dry friction, the needle is drawn back by 5 mm."""
    dry = Tissue.uniform(viscous_n_mm_s_per_mm=BETA, kinetic_n_mm_per_mm=0.03)
    design = ControllerDesign(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, limits=MotorLimits(torque_n_mm=1.0)
    )
    run = turn(
        "friction_aware", depth_cm=10, free_mm=50, tissue=dry, design=design, noise=None, hold_s=4.0
    ).run
    scheduled = 50 + 2.5 * run.time_s
    assert (run.inputs.free_mm - scheduled).max() == pytest.approx(5.0, abs=0.1)
    assert run.inputs.inserted_mm == pytest.approx(100.0)


def test_a_plan_respects_rate_and_torque():
    limits = MotorLimits(rate_deg_s=400, torque_n_mm=1.5)
    design = ControllerDesign(needle=NITINOL, damping_n_mm_s_per_mm=BETA, limits=limits)
    controlled = turn(
        "least_time", depth_cm=10, free_mm=50, tissue=VISCOUS, design=design, noise=None, hold_s=1.0
    )
    rate = np.abs(np.diff(controlled.run.inputs.drive)) / np.diff(controlled.run.time_s)
    assert rate.max() <= 400 * (1 + 1e-6)
    # The plan keeps its own model's torque below the limit; the needle's overshoots by what
    # ten modes leave out of it.
    assert np.abs(controlled.run.base_torque_n_mm).max() < 1.1 * 1.5


def test_a_step_response_is_measured_from_the_step_on():
    """On a made-up tip: 90 deg less 90 exp(-5 t), and an overshoot of 4 deg at one sample."""
    run = turn("base_only", depth_cm=10, free_mm=50, tissue=VISCOUS, noise=None, hold_s=3.0).run
    after = run.time_s >= 0.1 - 1e-9
    tip = np.where(after, 90 * (1 - np.exp(-5 * (run.time_s - 0.1))), 0.0)
    tip[-2] = 94.0
    outputs = run.outputs.copy()
    outputs[:, memory_map.O_TIP_ANGLE] = np.radians(tip)
    settle, integral, overshoot, largest = response_metrics(replace(run, outputs=outputs))
    assert settle == pytest.approx(3.0)  # the sample that overshoots is the last outside 3 deg
    assert integral == pytest.approx(90 / 5 * (1 - math.exp(-10)), rel=1e-4)
    assert (overshoot, largest) == pytest.approx((4.0, 90.0))


def test_the_largest_shear_stress_and_the_last_error_are_those_of_the_run():
    run = turn("base_only", depth_cm=10, free_mm=50, tissue=VISCOUS, noise=None, hold_s=1.5).run
    # The first element has no friction on it: it carries the base's torque, but for its inertia.
    by_base = NITINOL.shear_stress_mpa(float(np.abs(run.base_torque_n_mm).max()))
    assert largest_shear_stress_mpa(run) == pytest.approx(by_base, rel=1e-3)
    # The tip comes nearer all the time: its largest error of the last second is the first.
    assert final_error_deg(run) == pytest.approx(90 - np.interp(0.6, run.time_s, run.tip_deg), rel=0.01)


def test_a_motor_under_a_servo_turns_the_tip_as_the_filtered_command_does():
    """The needle's own torque makes no difference to the shaft, nor does a rotor to the tip."""
    hardware = LoopHardware(servo=Servo(natural_frequency_hz=10))
    motor = Drive(kind="torque", rotor_inertia_kg_m2=2.5e-5)
    tips = [
        step_on(
            ControlPlant(name="", drive=drive, hardware=hardware, noise=None),
            "feedforward",
            depth_cm=10,
            free_mm=50,
            hold_s=0.6,
        ).run.tip_deg
        for drive in (Drive(), motor)
    ]
    # Less than a sample of latency: 2 ms of a tip that turns at 450 deg/s at the most.
    assert np.abs(tips[0] - tips[1]).max() < 0.9

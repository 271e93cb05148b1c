"""Rigs that differ from the design, and which controllers stand which of them."""

import math

import pytest

from studies.control.comparison import SAME_LIMITS, SLOW_BASELINE, compare
from studies.control.robustness import (
    ROBUST_CONTROLLERS,
    WITH_TIMING,
    misjudged_delays,
    plants,
    robustness,
    unmodelled_tissues,
)
from studies.control.step_response import (
    final_error_deg,
    largest_shear_stress_mpa,
    response_metrics,
    step_on,
)
from studies.control.tip_controllers import TIP_CONTROLLERS

RIGS = plants() | misjudged_delays()


def response(rig, controller, hold_s=2.0):
    """Settling, overshoot and last error of one controller on one rig."""
    run = step_on(RIGS[rig], controller, depth_cm=10, free_mm=50, hold_s=hold_s).run
    settle, _, overshoot, _ = response_metrics(run)
    return settle, overshoot, final_error_deg(run)


def test_of_the_compensators_only_the_friction_aware_one_settles_in_much_dry_friction():
    dry = unmodelled_tissues()["dry friction"]
    names = ("base_only", "feedforward", "friction_aware")
    found = {
        r.controller: r for r in compare(dry, depth_cm=10.0, free_mm=50.0, controllers=names, hold_s=4.0)
    }
    assert math.isnan(found["base_only"].settle_s)
    assert math.isnan(found["feedforward"].settle_s)
    assert found["friction_aware"].settle_s < 2.0


def test_the_adaptive_estimator_recovers_what_wrong_damping_costs():
    wrong = unmodelled_tissues()["damping x 0.5"]
    names = ("base_only", "feedforward", "adaptive", "feedback")
    found = {
        r.controller: r  # the overshoot comes within a second
        for r in compare(wrong, depth_cm=10.0, free_mm=50.0, controllers=names, hold_s=2.0)
    }
    lost = found["feedforward"].overshoot_deg - found["feedback"].overshoot_deg
    left = found["adaptive"].overshoot_deg - found["feedback"].overshoot_deg
    assert lost > 1.0
    assert left < 0.3 * lost


def test_a_known_delay_costs_the_predictive_regulator_nothing_and_the_other_sixteen_degrees():
    assert response("delay 40 ms", "lqr")[1] > 10
    settle, overshoot, _ = response("delay 40 ms", "predictive")
    exact = response("as designed", "predictive")
    assert settle == pytest.approx(exact[0], abs=0.03)
    assert overshoot == pytest.approx(exact[1], abs=0.5)


def test_a_delay_that_is_assumed_twice_too_long_makes_the_predictive_regulator_swing():
    settle, overshoot, _ = response("delay 40 ms, 80 ms assumed", "predictive", hold_s=3.0)
    assert math.isnan(settle)
    assert overshoot > 10


@pytest.mark.parametrize("rig", ["servo 10 Hz, 10 ms", "motor 10 Hz, 10 ms"])
def test_a_known_servo_is_part_of_the_predictive_design(rig):
    assert response(rig, "lqr", hold_s=1.5)[1] > 10
    assert response(rig, "predictive", hold_s=1.5)[1] < 3.5


def test_a_torque_bias_stays_in_the_tip_unless_it_is_estimated():
    biased, unbiased = (response("torque bias 0.1 N mm", n, 4.0)[2] for n in ("feedforward", "unbiased"))
    assert biased > 1.0
    assert unbiased < 0.1


def test_a_bias_that_is_followed_in_motion_is_confused_with_tissue_that_creeps():
    """Soft tissue holds a torque for seconds: it is not observable that this is no bias."""
    settle, _, left = response("soft-plastisol", "bias_tracking", hold_s=4.0)
    assert math.isnan(settle)
    assert left > 3.0
    assert response("soft-plastisol", "unbiased", hold_s=4.0)[0] < 1.0


@pytest.mark.parametrize(
    ("rig", "faster"), [("stiffness x 0.8", 0.2), ("deep layer 4 x", 0.1), ("all, no dry friction", 0.3)]
)
def test_a_tip_sensor_helps_where_the_plant_differs_from_the_model(rig, faster):
    blind, seeing = (response(rig, name, hold_s=2.5)[0] for name in ("feedforward", "feedback"))
    assert seeing < (1 - faster) * blind


def test_on_the_plant_of_its_design_a_tip_sensor_changes_nothing():
    """Negative control."""
    blind, seeing = (response("as designed", name)[0] for name in ("feedforward", "feedback"))
    assert seeing == pytest.approx(blind, abs=0.02)


@pytest.mark.parametrize("controller", ["feedforward", "least_time"])
def test_a_shaft_with_a_limit_keeps_it(controller):
    limited, free = (
        largest_shear_stress_mpa(step_on(RIGS[rig], controller, depth_cm=10, free_mm=50, hold_s=0.6).run)
        for rig in ("shear below 230 MPa", "as designed")
    )
    # The torque is foreseen from a noisy sample: 0.015 N mm are 0.4 MPa.
    assert limited < 230 + 3 * 0.4
    assert free > 300


@pytest.mark.parametrize("controller", ["feedforward", "predictive", "least_time"])
def test_a_shaft_keeps_its_limit_behind_late_sensors_and_a_servo_too(controller):
    rig = "shear, 40 ms, 10 Hz"
    run = step_on(RIGS[rig], controller, depth_cm=10, free_mm=50, hold_s=0.6).run
    assert 150 < largest_shear_stress_mpa(run) < 230


def test_only_friction_aware_control_settles_with_everything_wrong_at_once():
    assert math.isnan(response("all of it", "feedback", hold_s=4.0)[0])
    assert response("all of it", "friction_aware_feedback", hold_s=4.0)[0] < 3.0


def test_every_rig_is_told_apart_and_every_controller_exists():
    assert set(ROBUST_CONTROLLERS) <= set(TIP_CONTROLLERS)
    assert ROBUST_CONTROLLERS[:2] == (SAME_LIMITS, SLOW_BASELINE) == WITH_TIMING[:2]
    assert all(rig.name == name for name, rig in RIGS.items())


def test_rows_name_rig_and_tissue():
    rows = robustness(5.0, 0.0, rigs=("encoder 0.36 deg",), controllers=("base_only_at_limit",))
    assert [(row.plant, row.tissue) for row in rows] == [("encoder 0.36 deg", "viscous-plastisol")]

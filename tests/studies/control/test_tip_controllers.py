"""Tip controllers by name: what they feed their estimator, and what they log."""

import math

import pytest

from models.errors import UnknownName
from sim.closed_loop import Measurement
from studies.control.step_response import DESIGN
from studies.control.tip_controllers import TIP_CONTROLLERS, tip_controller_named


def measured(time_s=0.0, **values):
    rest = {"base_deg": 0.0, "torque_n_mm": 0.0, "tip_deg": 0.0, "inserted_mm": 100.0, "free_mm": 50.0}
    return Measurement(time_s=time_s, **(rest | values))


def test_unknown_controllers_are_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="least_time"):
        tip_controller_named("magic", DESIGN)


@pytest.mark.parametrize("name", TIP_CONTROLLERS)
def test_an_untwisted_needle_at_its_reference_stays(name):
    controller = tip_controller_named(name, DESIGN)
    bases = [controller(measured(0.002 * i), 0.0) for i in range(5)]
    assert bases == pytest.approx([0.0] * 5, abs=1e-9)
    assert controller.estimated_tip_deg == pytest.approx(0.0)
    assert controller.advance_mm == 0.0


@pytest.mark.parametrize("name", TIP_CONTROLLERS)
def test_only_feedback_uses_the_tip_sensor(name):
    blind, seeing = tip_controller_named(name, DESIGN), tip_controller_named(name, DESIGN)
    for i in range(5):
        blind(measured(0.002 * i), 0.0)
        seeing(measured(0.002 * i, tip_deg=20.0), 0.0)
    differs = blind.estimated_tip_deg != seeing.estimated_tip_deg
    assert differs == name.endswith("feedback") == seeing.uses_tip_sensor


@pytest.mark.parametrize("name", TIP_CONTROLLERS)
def test_signals_are_finite_and_named_with_their_units(name):
    controller = tip_controller_named(name, DESIGN)
    controller(measured(), 10.0)
    signals = controller.signals()
    assert all(math.isfinite(value) for value in signals.values())
    modes = [key for key in signals if key.startswith("estimate_mode_")]
    assert len(modes) == (0 if controller.estimator is None else DESIGN.order - 1)
    assert {"estimate_tip_deg", "command_base_deg", "rate_limited_count"} <= set(signals)


def test_only_those_that_estimate_a_bias_log_one_and_take_it_off():
    for name in ("feedforward", "adaptive", "unbiased", "predictive_unbiased"):
        controller = tip_controller_named(name, DESIGN)
        for i in range(50):
            controller(measured(0.002 * i, torque_n_mm=0.1), 0.0)
        estimates = name.endswith("unbiased")
        assert controller.signals().get("estimate_bias_n_mm", 0.0) == pytest.approx(
            0.1 if estimates else 0.0, abs=0.001
        )


@pytest.mark.parametrize("name", ["base_only", "feedforward", "lqr"])
def test_a_controller_that_was_reset_acts_as_a_new_one(name):
    def bases(controller):
        return [controller(measured(0.01 * i, torque_n_mm=0.2 * i), 90.0) for i in range(20)]

    used, new = tip_controller_named(name, DESIGN), tip_controller_named(name, DESIGN)
    first = bases(used)
    used.reset()
    assert used.estimated_tip_deg == 0.0
    assert bases(used) == bases(new) == first

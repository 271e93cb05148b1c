"""Runs against closed forms, and balances of torque and energy."""

import numpy as np
import pytest

from models.tissue import Tissue
from sim.simulation import simulate
from studies.crosscheck import motion


@pytest.mark.parametrize(
    "checks",
    [
        lambda: [motion.check_arrangements()],
        motion.order_in_step,
        lambda: [motion.check_first_order_turn()],
        motion.check_steady_twist,
        motion.check_balances,
    ],
    ids=["arrangements", "order", "first order", "steady twist", "balances"],
)
def test_the_needle_passes(checks):
    for check in checks():
        assert check.passed, check


def test_damping_that_is_one_percent_off_fails_the_fast_turn(monkeypatch):
    """Negative control: the bound sees what it should see."""
    monkeypatch.setattr(motion, "_DAMPING", 1.01 * motion._DAMPING)
    wrong = motion.viscous_setup()
    monkeypatch.undo()
    assert motion.tip_error_deg(motion.viscous_setup(), motion.fast_turn()) < 0.02
    assert motion.tip_error_deg(wrong, motion.fast_turn()) > 0.1


def test_the_strain_energy_of_a_uniform_twist_is_half_torque_times_angle():
    """Held at 30 deg against a torque at the tip, the shaft has one twist from end to end."""
    setup = motion.viscous_setup(free_mm=50.0)
    run = simulate([setup], motion.fast_turn(free_mm=50.0), keep_shape=True)[0]
    x = setup.nodes_mm / setup.nodes_mm[-1]
    angle = np.radians(30.0)
    uniform = np.tile(angle * (1 - x), (run.time_s.size, 1))
    twisted = type(run)(setup=setup, inputs=run.inputs, outputs=run.outputs, angles_rad=uniform)
    torque = setup.needle.rigidity_n_mm2 / 250.0 * angle * 1e-3  # N m
    assert motion._strain_energy_j(twisted) == pytest.approx(0.5 * torque * angle)


def test_yielding_gelatin_has_the_friction_of_gelatin_and_leads_more():
    """Fig. 4: what the tip turns back before the base overtakes it grows with the tissue's give."""
    elastic = motion.elastic_gelatin().layers[0].interface
    rigid = Tissue.uniform(shared_n_mm_per_mm=elastic.shared_n_mm_per_mm)
    assert motion.reversal_lead_deg(motion.elastic_gelatin()) > motion.reversal_lead_deg(rigid) + 5

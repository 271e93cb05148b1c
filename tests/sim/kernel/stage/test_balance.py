"""Friction by balance of the shaft, in the interpreter."""

import numpy as np
import pytest

from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.needles.setup import Setup

DAMPING, TIP, SHARE = 0.02, 2e-5, 0.7  # N mm s per mm, N m, of the step


@pytest.fixture
def stage(interpreted, at_stage):
    """A stage of a viscous tissue that Newton's method has solved."""
    setup = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING),
        discretisation=Discretisation(elements=4),
        free_mm=20,
        inserted_mm=60,
    )
    prepared = at_stage(setup)
    prepared.w.set[:] = 0.0
    solved, *_ = interpreted.newton.newton(
        prepared.head, prepared.law, prepared.w, prepared.frame, 0.5, TIP, False, False
    )
    assert solved
    return prepared


def _friction(interpreted, stage, weight=SHARE):
    tissue = np.zeros(stage.w.omega.size)
    torque, _ = interpreted.chuck.drive_torque(stage.w, stage.frame, 0.5)
    return tissue, interpreted.balance.friction(stage.w, stage.frame, torque, TIP, weight, tissue)


def test_of_viscous_tissue_it_is_the_damping_times_the_rates(interpreted, stage):
    """Each node's: C omega, with the tridiagonal matrix C of the rows."""
    w = stage.w
    matrix = np.diag(w.damp_diagonal) + np.diag(w.damp_upper[:-1], 1) + np.diag(w.damp_lower[1:], -1)
    tissue, (total, power) = _friction(interpreted, stage)
    expected = matrix @ w.omega
    rounding = 1e-9 * np.abs(expected).max()  # of Newton's tolerance, 1e-10
    assert tissue == pytest.approx(-SHARE * expected, abs=rounding)
    assert total == pytest.approx(expected.sum(), rel=1e-9)
    assert power == pytest.approx(w.omega @ expected, rel=1e-9)


def test_what_tissue_does_to_the_nodes_is_added_up_over_the_stages(interpreted, stage):
    once, _ = _friction(interpreted, stage)
    tissue = once.copy()
    torque, _ = interpreted.chuck.drive_torque(stage.w, stage.frame, 0.5)
    interpreted.balance.friction(stage.w, stage.frame, torque, TIP, SHARE, tissue)
    assert tissue == pytest.approx(2 * once)


def test_a_twisted_shaft_stores_half_of_torque_times_twist(interpreted, stage):
    w = stage.w
    end = np.linspace(0.3, 0.0, w.omega.size)
    twist = np.diff(end)
    energy, largest = interpreted.balance.stored_in_shaft(w, end)
    assert energy == pytest.approx(0.5 * w.spring[:-1] @ twist**2)
    assert largest == pytest.approx(np.max(w.spring[:-1] * np.abs(twist)))
    w.set[:] = twist  # what an element keeps without a torque stores nothing
    assert interpreted.balance.stored_in_shaft(w, end) == pytest.approx((0.0, 0.0))

"""The balance of torques: its linearisation against differences, and the chuck."""

import math

import numpy as np
import pytest

from validation.rig.balance import chuck_torque, entry_turn, linearise, slip_rate

LAWS = {
    "nominal": {},
    "hardening": {"hardening": 1e4},
    "shear thinning": {"exponent": 0.6},
    "viscoelastic": {"compliance": 20.0, "retardation": 0.5},
    "dry": {"coulomb": 0.004, "entry": 0.1, "load": 0.4},
    "drive": {"half_gap": 0.01, "base_compliance": 0.1},
    "lumped": {"tip_drag": 0.2, "curvature": 0.001, "phase": 0.5},
}


def residual(made):
    linearise(made.law, made.chain, made.state, made.inputs, made.work, False)
    return made.work.residual.copy(), made.work.twist_increment.copy()


@pytest.mark.parametrize("name", LAWS)
@pytest.mark.parametrize("mesh", [{}, {"lagrangian": True}])
def test_rows_are_the_derivatives_of_the_residual(step, name, mesh):
    """The rows are the Jacobian after elimination of the twist, so the twist is solved on either side.

    Central differences at h = 1e-7 rad of torques of some 10 N mm: rounding leaves 1e-15 / h = 1e-8,
    some 1e-10 of the largest slope (100 N mm / rad); curvature, h^2 times a third derivative, less.
    """
    made = step(base=0.35, **mesh, **LAWS[name])
    for _ in range(60):  # the twist that belongs to these angles
        made.work.twist[:] += residual(made)[1]
    residual(made)
    lower, own, upper = (row.copy() for row in (made.work.lower, made.work.diagonal, made.work.upper))
    nodes = own.size
    jacobian = np.diag(own) + np.diag(lower[1:], -1) + np.diag(upper[:-1], 1)
    differences, angle, twist = np.empty((nodes, nodes)), made.work.angle.copy(), made.work.twist.copy()
    h = 1e-7
    for i in range(nodes):
        sides = []
        for sign in (1, -1):
            made.work.angle[:], made.work.twist[:] = angle, twist
            made.work.angle[i] += sign * h
            for _ in range(60):
                made.work.twist[:] += residual(made)[1]
            sides.append(residual(made)[0])
        differences[:, i] = -(sides[0] - sides[1]) / (2 * h)
    assert jacobian == pytest.approx(differences, rel=1e-6, abs=1e-6 * np.abs(jacobian).max())


def test_the_chuck_is_a_spring_with_play_that_slips_at_its_grip(step):
    made = step(half_gap=0.01, base_compliance=0.5, grip=1.0)
    stiffness = 1 / (1 / made.chain.link[0] + 0.5)
    assert chuck_torque(made.law, made.chain, made.state, 0.005, 0.0)[0] == 0.0
    torque, slope, slipped = chuck_torque(made.law, made.chain, made.state, 0.11, 0.0)
    assert (torque, slope, slipped) == (pytest.approx(0.1 * stiffness), stiffness, 0.0)
    torque, slope, slipped = chuck_torque(made.law, made.chain, made.state, 9.01, 0.0)
    assert (torque, slope) == (1.0, 0.0)
    assert slipped == pytest.approx(9.0 - 1.0 / stiffness)


def test_a_strain_hardening_spring_adds_the_cube_of_the_strain(step):
    soft, hard = step(), step(hardening=1e4)
    one = chuck_torque(soft.law, soft.chain, soft.state, 0.4, 0.0)[0]
    other = chuck_torque(hard.law, hard.chain, hard.state, 0.4, 0.0)[0]
    strain = 0.4 / hard.chain.link_mm[0]
    assert other / one == pytest.approx(1 + 1e4 * strain**2)


def test_slip_is_of_the_shaft_against_the_tissue(step):
    made = step(lead=100.0)
    made.work.angle[3], made.work.twist[3] = 0.2, 0.05
    made.work.angle_past[3], made.work.twist_past[3] = -3.0, -1.0
    assert slip_rate(made.inputs, made.work, 3) == pytest.approx(100 * 0.15 - 3 + 1)


def test_the_turn_at_the_entry_is_weighted_by_what_passes(step):
    made = step(lagrangian=True)
    made.work.angle[:] = np.cumsum(made.chain.link_mm)  # 1 rad/mm: the turn is the position
    assert entry_turn(made.chain, made.state, made.work) == pytest.approx(40.0)


def test_lagged_rates_set_the_dry_level(step):
    made = step(base=0.35, kinetic=0.002, static=0.005, stribeck=0.4)
    made.work.lagged_rate[:] = math.inf  # far above the Stribeck rate: the kinetic level
    linearise(made.law, made.chain, made.state, made.inputs, made.work, True)
    lagged = made.work.residual.copy()
    kinetic = step(base=0.35, coulomb=0.002)
    linearise(kinetic.law, kinetic.chain, kinetic.state, kinetic.inputs, kinetic.work, False)
    assert lagged == pytest.approx(kinetic.work.residual, rel=1e-12)

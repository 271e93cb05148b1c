"""The balance of torques: its linearisation against differences."""

import math

import numpy as np
import pytest

from validation.rig.balance import entry_turn, linearise, slip_rate

LAWS = {
    "nominal": {},
    "hardening": {"hardening": 1e4},
    "shear thinning": {"exponent": 0.6},
    "viscoelastic": {"compliance": 20.0, "retardation": 0.5},
    "dry": {"coulomb": 0.004, "entry": 0.1, "load": 0.4},
    "drive": {"half_gap": 0.01, "base_compliance": 0.1},
    "soft chuck": {"soft_play": 0.3, "soft_torque": 0.5},
    "set": {"yield_torque": 0.2, "yield_slope": 0.5},
    "tissue": {"compliance": 20.0, "retardation": 0.5, "tissue_hardening": 40.0, "stiffening": 3.0},
    "rates": {"saturation": 0.8, "coulomb": 0.004, "pressing": 1.5},
    "fibres": {"tip_dry": 0.1, "fibre": 0.3, "fibre_phase": 0.2},
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

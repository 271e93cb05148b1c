"""Yielding tissue, drag at the tip: MuJoCo agrees with closed forms, a wrong needle does not."""

from dataclasses import replace

import numpy as np
import pytest

from models.drive import DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from studies.crosscheck import linear
from studies.crosscheck.poles import BOUND

CASE = (100.0, 50.0, DriveKind.ANGLE)
LAW = linear.YIELDING.layers[0].interface


def softened(**factors):
    """Soft plastisol with some of its constants multiplied."""
    names = ("viscous_n_mm_s_per_mm", "stiffness_n_mm_per_rad_per_mm", "time_constant_s")
    return Tissue.uniform(**{name: getattr(LAW, name) * factors.get(name, 1.0) for name in names})


def test_every_check_holds():
    checks = linear.linear_checks()
    assert len(checks) == 3 + 4
    assert all(check.passed for check in checks), checks


@pytest.mark.parametrize(
    ("field", "pole"),
    [
        ("viscous_n_mm_s_per_mm", 1),
        ("stiffness_n_mm_per_rad_per_mm", 0),
        ("time_constant_s", 1),
    ],
)
def test_tissue_that_is_three_percent_off_is_caught(field, pole):
    """Negative control: creeping poles (0) go with the stiffness, quick ones (1) with the dampers."""
    right = linear.yielding(*CASE)
    setup = linear.needle_setup(*CASE, tissue=softened(**{field: 1.03}))
    found = linear.measure_yielding(setup, right)[pole][0]
    assert abs(found / right.poles_rad_s(1)[0, pole] - 1) > BOUND
    # ... by as much as the closed form of the wrong tissue says: pole 1 of 4 is good to 1e-4.
    names = {"time_constant_s": right.time_constant_s}
    names["stiffness_n_mm_per_rad_per_mm"] = right.stiffness_n_mm_per_rad_per_mm
    if field in names:
        wrong = replace(right, **{field: 1.03 * names[field]})
    else:
        damping = 1.03 * right.viscous.damping_n_mm_s_per_mm
        wrong = replace(right, viscous=replace(right.viscous, damping_n_mm_s_per_mm=damping))
    assert found == pytest.approx(wrong.poles_rad_s(1)[0, pole], rel=1e-4)


@pytest.mark.parametrize("length", linear.LENGTHS_MM)
@pytest.mark.parametrize("free", [0.0, 50.0])
def test_creeping_poles_take_a_quarter_of_an_error_in_the_wavenumber_at_most(length, free):
    right = linear.yielding(length, free, DriveKind.ANGLE)
    stiffer = NITINOL.but(shear_modulus_gpa=1.005 * NITINOL.shear_modulus_gpa)  # 0.5 % of kappa w^2
    moved = replace(right, viscous=replace(right.viscous, needle=stiffer))
    change = np.abs(moved.poles_rad_s(4) / right.poles_rad_s(4) - 1)[:, 0]
    assert 0.0001 < change.max() <= linear.CREEP_BOUND


def test_a_drag_that_is_left_out_or_doubled_is_caught():
    """Negative control: 2 cm of shaft more or less in 10."""
    exact = linear.dragged(100.0, 0.0, DriveKind.ANGLE)
    right = linear._viscous_setup(100.0, 0.0, DriveKind.ANGLE)
    for factor in (0.0, 2.0):
        drag = factor * linear.DRAGGED.tip_drag_n_mm_s_per_rad
        wrong = linear.needle_setup(
            100.0,
            0.0,
            DriveKind.ANGLE,
            needle=NITINOL.but(tip_drag_n_mm_s_per_rad=drag),
            tissue=right.tissue,
        )
        assert linear.response_error_deg(wrong, exact) > 100 * linear.RESPONSE_BOUND_DEG


def test_the_bound_of_the_response_is_what_the_step_makes_of_the_modes():
    """Alexander's method has R(p h) where a mode has exp(p h): its sum over modes, at one corner."""
    gamma, step_s, rate_deg_s = 1 - np.sqrt(0.5), 0.01, 300.0
    exact = linear.yielding(200.0, 0.0, DriveKind.ANGLE)
    z = exact.poles_rad_s(16).ravel() * step_s
    shares = (exact.shares(16) * exact.viscous.participation(16)[:, None]).ravel()
    grown = (1 + (1 - 2 * gamma) * z) / (1 - gamma * z) ** 2
    n = np.arange(1, 100)
    error = (shares * rate_deg_s * step_s / z) @ (grown[:, None] ** n - np.exp(z[:, None] * n))
    a_corner = np.abs(error).max()
    assert a_corner == pytest.approx(0.0043, abs=1e-4)
    assert 2 * a_corner < linear.RESPONSE_BOUND_DEG < 4 * a_corner


def test_poles_are_recovered_from_two_instants_of_a_system_with_a_hidden_state():
    """Three angles, each with a state of its own that is not seen: an exact matrix exponential."""
    rates = -np.array([0.2, 0.5, 0.9, 3.0, 8.0, 20.0])
    mixing = np.random.default_rng(3).normal(size=(6, 6)) + 3 * np.eye(6)
    step = mixing @ np.diag(np.exp(0.02 * rates)) @ np.linalg.inv(mixing)
    states = [np.linalg.matrix_power(step, k)[:3, :3] for k in range(60)]
    found = linear._realised_poles(np.array(states), apart=20) / 0.02
    assert found == pytest.approx(rates, rel=1e-5)

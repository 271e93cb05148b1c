"""Poles identified from MuJoCo agree with the closed form, and those of a wrong needle do not."""

import pytest

from models.drive import DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.spec import Setup
from studies.crosscheck import poles
from studies.crosscheck.findings import Pole


@pytest.fixture(scope="module")
def measured():
    return poles.compare_poles()


def test_every_pole_is_within_half_a_percent(measured):
    assert len(measured) == 3 * 2 * 2 * 4
    assert max(pole.error for pole in measured) <= 0.005


def test_the_worst_pole_decides(measured):
    wrong = Pole(length_mm=50, free_mm=0, drive="angle", mode=1, measured=-1.006, closed_form=-1.0)
    assert poles.check_poles(measured).passed
    assert not poles.check_poles([*measured, wrong]).passed


@pytest.mark.parametrize("error", [{"damping": 1.01}, {"stiffness": 1.01}])
def test_a_needle_that_is_one_percent_off_is_caught(error):
    """Negative control: the measurement sees what it should see."""
    good = poles.chain(100.0, 50.0, DriveKind.ANGLE)
    damping = 0.01725 * error.get("damping", 1.0)
    wrong = Setup(
        needle=NITINOL.but(shear_modulus_gpa=27.2 * error.get("stiffness", 1.0)),
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=damping),
        drive=good.drive,
        mesh=good.mesh,
        free_mm=good.free_mm,
        inserted_mm=good.inserted_mm,
    )
    expected = poles.closed_form_needle(100.0, 50.0, DriveKind.ANGLE).poles_rad_s(1)[0]
    assert abs(poles.measure(good, 1)[0] / expected - 1) < 1e-4
    assert abs(poles.measure(wrong, 1)[0] / expected - 1) == pytest.approx(0.01, rel=0.05)


def test_convergence_in_elements():
    checks = poles.order_in_elements()
    assert [check.passed for check in checks] == [True, True], checks

"""Poles identified from MuJoCo agree with the closed form, and those of a wrong needle do not."""

from dataclasses import replace

import pytest

from models.drive import DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.needles.setup import Setup
from studies.crosscheck import poles
from studies.crosscheck.findings import Pole, PoleSource


@pytest.fixture(scope="module")
def measured():
    return poles.compare_poles()


@pytest.mark.slow
@pytest.mark.parametrize("source", list(poles.SOURCES))
def test_every_pole_of_a_source_is_within_its_bound(measured, source):
    found = [pole for pole in measured if pole.source is source]
    assert len(found) == 3 * 2 * 2 * 4
    assert max(pole.error for pole in found) <= poles.SOURCES[source].bound


def test_bounds_are_half_a_percent_and_for_the_native_needle_less_than_a_fifth_of_that():
    assert poles.SOURCES[PoleSource.SECOND_ORDER].bound == 0.005
    assert poles.SOURCES[PoleSource.NATIVE].bound < 0.001


@pytest.mark.slow
@pytest.mark.parametrize("source", list(poles.SOURCES))
def test_the_worst_pole_of_each_source_decides(measured, source):
    case = {
        "length_mm": 50,
        "free_mm": 0,
        "drive": "angle",
        "mode": 1,
        "closed_form": -1.0,
        "bound": 0.005,
    }
    wrong = Pole(**case, source=source, measured=-1.016)
    assert all(check.passed for check in poles.check_poles(measured))
    checks = poles.check_poles([*measured, wrong])
    failed = [check.name for check in checks if not check.passed]
    assert len(failed) == 1
    native = failed[0].startswith("worst pole, without callbacks: ")
    assert native is (source is PoleSource.NATIVE)


def test_damping_of_the_native_needle_that_is_one_percent_off_fails_its_check(monkeypatch):
    """Negative control: the check of that source fails, and no other."""
    native = poles.SOURCES[PoleSource.NATIVE]

    def measured_in_other_tissue(*case):
        rig = poles.closed_form_needle(*case)
        other = replace(rig, damping_n_mm_s_per_mm=1.01 * rig.damping_n_mm_s_per_mm)
        return poles.measure_native(other, poles.COUNT)

    wrong = replace(native, measure=measured_in_other_tissue)
    monkeypatch.setitem(poles.SOURCES, PoleSource.NATIVE, wrong)
    checks = poles.check_poles(poles.compare_poles((100.0,)))
    failed = [check.name for check in checks if not check.passed]
    assert len(failed) == 1
    assert failed[0].startswith("worst pole, without callbacks: ")


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

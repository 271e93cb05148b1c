"""The cross-check passes on the needle, and fails on needles that are wrong."""

import json
import math

import pytest

from models.drive import DriveKind
from models.errors import OutputExists
from models.needle import NITINOL
from models.tissue import Tissue
from sim.spec import Setup
from studies.crosscheck import motion, paper, poles
from studies.crosscheck.findings import Check, Comparison, Findings, Pole
from studies.crosscheck.report import FILES, write_report


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
    expected = poles.held_needle(100.0, 50.0, DriveKind.ANGLE).poles_rad_s(1)[0]
    assert abs(poles.measure(good, 1)[0] / expected - 1) < 1e-4
    assert abs(poles.measure(wrong, 1)[0] / expected - 1) == pytest.approx(0.01, rel=0.05)


@pytest.mark.parametrize("check", poles.order_in_elements(), ids=lambda c: c.name)
def test_convergence_in_elements(check):
    assert check.passed, check


@pytest.mark.parametrize(
    "check",
    [motion.check_arrangements(), *motion.check_steady_twist(), *motion.check_balances()],
    ids=lambda c: c.name,
)
def test_balances_hold(check):
    assert check.passed, check


def test_a_check_fails_outside_its_bounds_and_on_nan():
    assert Check(name="x", value=1.0, unit="-", low=0, high=1).passed
    assert not Check(name="x", value=1.1, unit="-", high=1).passed
    assert not Check(name="x", value=math.nan, unit="-", high=1).passed


def test_the_audited_figures_are_reproduced():
    found = {c.item: c for c in paper.compare_all()}
    assert found["Table III, inertialess modal, mode 1"].ours == pytest.approx(-4.628, abs=1e-3)
    assert found["Table III, inertialess modal, mode 1"].ratio == pytest.approx(1 / 0.5806, rel=1e-3)
    assert found["k_t per mm"].ours == pytest.approx(5.16e-3, abs=1e-5)
    assert found["b at 200 mm, line through Table II"].ours == pytest.approx(3.4507, abs=1e-4)
    hard = found["Fig. 8, hard: within 3 deg"].ours
    assert hard == pytest.approx(5.07, abs=0.02)
    behind = "integral over 2 s, behind the base"
    assert found[f"Fig. 8, hard: {behind}"].ours == pytest.approx(106, abs=0.5)
    assert found[f"Fig. 8, soft: {behind}"].ours == pytest.approx(57, abs=1)
    assert math.isnan(found["Fig. 8, soft: within 3 deg"].ours)
    item = "Table IV, base only, 10 cm, 50 mm free"
    assert found[item].ours == pytest.approx(1.80, abs=0.01)


def test_lumped_columns_of_table_iii_keep_their_ratio_to_the_continuous_one():
    found = {c.item: c for c in paper.table_iii()}
    for masses in (64, 8):
        for k in range(1, 5):
            x = k * math.pi / (2 * masses)
            ratio = (
                found[f"Table III, lumped, {masses} masses, mode {k}"].ours
                / found[f"Table III, inertialess modal, mode {k}"].ours
            )
            assert ratio == pytest.approx((math.sin(x) / x) ** 2, rel=1e-5)


def test_settling_is_the_last_time_outside_the_band():
    time = [0.0, 1.0, 2.0, 3.0]
    import numpy as np

    assert paper.settling_s(np.array(time), np.array([9.0, 1.0, 5.0, 0.0])) == 3.0
    assert paper.settling_s(np.array(time), np.zeros(4)) == 0.0
    assert math.isnan(paper.settling_s(np.array(time), np.array([0.0, 0, 0, 9.0])))


def test_the_report_is_complete_and_strict_json(tmp_path, measured):
    findings = Findings(
        poles=measured,
        checks=[Check(name="c", value=2.0, unit="-", high=1)],
        comparisons=[Comparison(item="never", published=1.0, ours=math.nan, unit="s", source="here")],
    )
    paths = write_report(findings, tmp_path / "v")
    assert [p.name for p in paths] == list(FILES)
    content = json.loads(paths[0].read_text(), parse_constant=lambda c: pytest.fail(c))
    assert content["passed"] is False
    assert set(content["poles"][0]) == {
        "length_mm",
        "free_mm",
        "drive",
        "mode",
        "measured",
        "closed_form",
    }
    assert content["comparisons"][0]["ours"] is None
    with pytest.raises(OutputExists):
        write_report(findings, tmp_path / "v")

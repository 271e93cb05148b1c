"""Densities above any material's: a needle in kg/m3 is refused, a machine told as a shaft is not."""

import pytest
from analytic_log import change_rig

from diagnosis.log.checks.heavy_shaft import heavy_shaft_warnings, refuse_kg_m3
from diagnosis.log.nominal_rig import NominalNeedle
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog


def shaft(density, modulus=27.2):
    return NominalNeedle(diameter_mm=0.59, shear_modulus_gpa=modulus, density_g_cm3=density)


@pytest.mark.parametrize(
    ("density", "modulus"),
    [
        (6450.0, 27.2),  # Nitinol
        (7900.0, 77.0),  # steel
        (1050.0, 1.0),  # plastics
    ],
)
def test_a_material_in_kg_per_m3_is_refused_with_how_to_fix_it(tmp_path, density, modulus):
    said = rf"rig\.yaml: needle\.density_g_cm3: .*found {density:g}; .*divide it by 1000"
    with pytest.raises(UnusableLog, match=said):
        refuse_kg_m3(tmp_path / "rig.yaml", shaft(density, modulus))


@pytest.mark.parametrize(
    ("density", "modulus"),
    [
        (22.6, 27.2),  # osmium
        (8.0e6, 79.3),  # the inertia of a drill string, as a wire
        (2775.0, 0.0204),  # that of a slide, as a soft shaft
    ],
)
def test_a_material_and_a_machine_are_not(tmp_path, density, modulus):
    refuse_kg_m3(tmp_path / "rig.yaml", shaft(density, modulus))


def test_a_shaft_heavier_than_any_material_is_told():
    assert not heavy_shaft_warnings(shaft(22.6))
    (said,) = heavy_shaft_warnings(shaft(138766.0))
    assert "density_g_cm3 is 138766" in said
    assert "inertia of a machine" in said


def test_both_are_asked_where_a_log_is_read(log):
    change_rig(log, lambda c: c["needle"].update(density_g_cm3=1e5))
    assert any("inertia of a machine" in said for said in read_rig_log(log).warnings)
    change_rig(log, lambda c: c["needle"].update(density_g_cm3=6450))
    with pytest.raises(UnusableLog, match="divide it by 1000"):
        read_rig_log(log)

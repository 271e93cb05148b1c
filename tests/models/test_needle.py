"""The needle: its constants, the presets, and what is refused."""

import math

import numpy as np
import pytest

from models.errors import InvalidValue, UnknownName
from models.needle import NEEDLES, NITINOL, needle_named


def test_the_papers_needle_has_the_audited_polar_moment_and_rigidity():
    assert pytest.approx(0.011896, abs=5e-7) == NITINOL.polar_moment_mm4
    assert pytest.approx(323.58, abs=5e-3) == NITINOL.rigidity_n_mm2


def test_rotary_inertia_is_density_times_polar_moment_in_si():
    polar_m4 = math.pi * 0.59e-3**4 / 32
    assert NITINOL.rotary_inertia_kg_m == pytest.approx(6450 * polar_m4)


@pytest.mark.parametrize("field", ["diameter_mm", "shear_modulus_gpa", "density_g_cm3", "length_mm"])
@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, "thick", None])
def test_an_unphysical_needle_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        NITINOL.but(**{field: bad})


def test_a_needle_may_be_stiffer_than_any_that_a_file_may_name():
    """A fit varies the stiffness about its nominal value, which may be the largest plausible one."""
    assert NITINOL.but(shear_modulus_gpa=1001.0).rigidity_n_mm2 == pytest.approx(
        NITINOL.rigidity_n_mm2 * 1001.0 / 27.2
    )


def test_torsional_waves_run_at_the_root_of_modulus_over_density():
    assert NITINOL.wave_speed_m_s == pytest.approx(math.sqrt(NITINOL.shear_modulus_gpa * 1e9 / 6450))


def test_mass_per_length_is_density_times_cross_section():
    assert NITINOL.mass_kg_per_m == pytest.approx(6450 * math.pi * 0.295e-3**2)
    assert NITINOL.radius_mm == 0.295


def test_shear_stress_is_torque_times_radius_over_the_polar_moment():
    stress = NITINOL.shear_stress_mpa(2.0)
    assert stress == pytest.approx(2.0 * NITINOL.radius_mm / NITINOL.polar_moment_mm4)
    assert NITINOL.torque_n_mm_at(stress) == pytest.approx(2.0)


def test_an_unknown_needle_is_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="steel-1.27"):
        needle_named("gold")
    assert needle_named("nitinol-0.59") is NITINOL


def test_names_in_the_table_are_the_names_of_the_needles():
    assert all(name == needle.name for name, needle in NEEDLES.items())


def test_stiffness_along_the_shaft_is_straight_between_its_places_and_level_beyond():
    needle = NITINOL.but(stiffness_along=(1.0, 2.0, 0.5), stiffness_along_mm=100.0)
    factors = needle.stiffness_factors(np.array([0.0, 25.0, 50.0, 100.0, 300.0]))
    np.testing.assert_allclose(factors, [1.0, 1.5, 2.0, 0.5, 0.5])
    np.testing.assert_array_equal(NITINOL.stiffness_factors(np.arange(3.0)), 1.0)
    with pytest.raises(InvalidValue, match="stiffness_along_mm"):
        NITINOL.but(stiffness_along=(1.0, 2.0))

"""Needle, tissue and drive: constants, presets and what they refuse."""

import math

import pytest

from models import published
from models.drive import Drive
from models.errors import InvalidValue, UnknownName
from models.lag import lag_deg, level_n_mm_per_mm, steady_lag_deg
from models.materials import MATERIALS, tissue_named
from models.needle import NEEDLES, NITINOL, Needle, needle_named
from models.tissue import Interface, Layer, Tissue


def test_the_papers_needle_has_the_audited_polar_moment_and_rigidity():
    assert pytest.approx(0.011896, abs=5e-7) == NITINOL.polar_moment_mm4
    assert pytest.approx(323.58, abs=5e-3) == NITINOL.rigidity_n_mm2


def test_rotary_inertia_is_density_times_polar_moment_in_si():
    polar_m4 = math.pi * 0.59e-3**4 / 32
    assert NITINOL.rotary_inertia_kg_m == pytest.approx(6450 * polar_m4)


def test_the_lag_of_simtest_follows_from_equation_2():
    lag = lag_deg(NITINOL, base_torque_n_mm=1.0, free_mm=230, inserted_mm=100)
    assert lag == pytest.approx(49.6, abs=0.05)


def test_level_from_lag_is_the_inverse_of_lag_from_torque():
    level = level_n_mm_per_mm(NITINOL, lag_deg=12.0, free_mm=80, inserted_mm=60)
    back = lag_deg(NITINOL, base_torque_n_mm=level * 60, free_mm=80, inserted_mm=60)
    assert back == pytest.approx(12.0)


def test_a_steady_turn_lags_in_proportion_to_its_rate():
    lengths = {"damping_n_mm_s_per_mm": 0.017, "free_mm": 50, "inserted_mm": 100}
    one, two = (steady_lag_deg(NITINOL, rate_rad_s=r, **lengths) for r in (0.1, 0.2))
    assert two == pytest.approx(2 * one)


def test_table_ii_gives_the_papers_damping_at_200_mm():
    law = tissue_named("viscous-plastisol").layers[0].interface
    stated = published.DAMPING_200_MM.value
    assert law.viscous_n_mm_s_per_mm * 200 == pytest.approx(stated, rel=1e-3)


def test_every_material_says_what_its_source_does_not_state():
    assert all(tissue.unknown for tissue in MATERIALS.values())


@pytest.mark.parametrize("field", ["diameter_mm", "shear_modulus_gpa", "density_g_cm3", "length_mm"])
@pytest.mark.parametrize("bad", [0.0, -1.0, math.nan, math.inf, "thick", None])
def test_an_unphysical_needle_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        NITINOL.but(**{field: bad})


def test_a_misspelt_field_is_answered_with_the_right_one():
    with pytest.raises(InvalidValue, match="did you mean 'diameter_mm'"):
        NITINOL.but(diametre_mm=0.5)


def test_a_record_cannot_be_changed():
    with pytest.raises(Exception, match="frozen"):
        NITINOL.diameter_mm = 1.0


def test_unknown_names_are_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="steel-1.27"):
        needle_named("gold")
    with pytest.raises(UnknownName, match="porcine-gelatin"):
        tissue_named("jelly")


def test_names_in_the_tables_are_the_names_of_their_records():
    assert all(name == needle.name for name, needle in NEEDLES.items())
    assert all(name == tissue.name for name, tissue in MATERIALS.items())


def test_static_friction_below_kinetic_is_refused():
    with pytest.raises(InvalidValue, match="static_n_mm_per_mm"):
        Interface(kinetic_n_mm_per_mm=2e-3, static_n_mm_per_mm=1e-3)


def test_a_static_peak_without_a_stribeck_rate_is_refused():
    with pytest.raises(InvalidValue, match="stribeck_rad_s"):
        Interface(kinetic_n_mm_per_mm=1e-3, static_n_mm_per_mm=2e-3)


def test_an_error_inside_a_layer_names_the_layer():
    with pytest.raises(InvalidValue, match=r"layers\.1\.interface"):
        Tissue(layers=[{"interface": {}, "thickness_mm": 5}, {"interface": {"exponent": -1}}])


def test_only_the_last_layer_may_be_open_ended():
    open_layer, closed = Layer(interface=Interface()), Layer(interface=Interface(), thickness_mm=3)
    with pytest.raises(InvalidValue, match=r"layers\.0\.thickness_mm"):
        Tissue(layers=(open_layer, open_layer))
    with pytest.raises(InvalidValue, match=r"layers\.0\.thickness_mm"):
        Tissue(layers=(closed,))


def test_layer_boundaries_follow_thickness_and_fraction():
    layers = (
        Layer(interface=Interface(), thickness_mm=10),
        Layer(interface=Interface(), fraction=0.5),
        Layer(interface=Interface()),
    )
    assert Tissue(layers=layers).boundaries_mm(100).tolist() == [0, 10, 60, 100]
    assert Tissue(layers=layers).boundaries_mm(8).tolist() == [0, 8]


def test_negative_backlash_is_refused():
    with pytest.raises(InvalidValue, match="backlash_deg"):
        Drive(backlash_deg=-1)


def test_a_missing_field_is_named():
    with pytest.raises(InvalidValue, match="density_g_cm3"):
        Needle(diameter_mm=1, shear_modulus_gpa=20)

"""Laws and layers of tissue, and what is refused."""

import pytest

from models.errors import InvalidValue
from models.tissue import Interface, Layer, Tissue


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
    assert Tissue(layers=layers).boundaries_mm(10 + 1e-9).tolist() == [0, 10 + 1e-9]


def test_a_layer_has_a_thickness_or_a_fraction_but_not_both():
    with pytest.raises(InvalidValue, match="either thickness_mm or fraction"):
        Layer(interface=Interface(), thickness_mm=3, fraction=0.5)


def test_without_a_static_level_friction_at_rest_is_the_kinetic_one():
    assert Interface(kinetic_n_mm_per_mm=2e-3).static_level_n_mm_per_mm == 2e-3
    peak = Interface(kinetic_n_mm_per_mm=1e-3, static_n_mm_per_mm=3e-3, stribeck_rad_s=0.1)
    assert peak.static_level_n_mm_per_mm == 3e-3


def test_uniform_tissue_is_one_layer_of_the_given_law():
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=0.02, entry_friction_n_mm=0.1)
    assert [layer.interface.viscous_n_mm_s_per_mm for layer in tissue.layers] == [0.02]
    assert tissue.boundaries_mm(80.0).tolist() == [0, 80]
    assert tissue.entry_friction_n_mm == 0.1

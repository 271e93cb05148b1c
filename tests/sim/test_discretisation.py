"""Nodes of the two meshes, and what is refused."""

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation, Mesh, SlipRate, node_positions_mm
from sim.needles.setup import Setup

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.017)


def nodes(mesh, *, free=50.0, inserted=100.0, sheath=False, tissue=VISCOUS, **cut):
    return node_positions_mm(
        Discretisation(**cut), mesh, tissue, free_mm=free, inserted_mm=inserted, sheath=sheath
    )


def test_a_mesh_in_layered_tissue_has_nodes_at_the_boundaries():
    layers = [
        {"interface": {"viscous_n_mm_s_per_mm": 0.01}, "thickness_mm": 13},
        {"interface": {"viscous_n_mm_s_per_mm": 0.02}},
    ]
    nodes = Setup(needle=NITINOL, tissue=Tissue(layers=layers), free_mm=50, inserted_mm=100).nodes_mm
    assert 50.0 in nodes
    assert np.abs(nodes - 63.0).min() < 1e-9
    assert nodes[-1] == 150.0


def test_a_lagrangian_mesh_is_even_from_chuck_to_tip():
    places, stretching = nodes(Mesh.LAGRANGIAN, elements=10)
    assert places == pytest.approx(np.linspace(0, 150, 11))
    assert stretching == 0


def test_an_eulerian_mesh_has_a_node_at_the_entry_and_one_free_element():
    places, stretching = nodes(Mesh.EULERIAN, elements=10)
    assert places[:2].tolist() == [0, 50]
    assert places[1:] == pytest.approx(np.linspace(50, 150, 11))
    assert stretching == 1


@pytest.mark.parametrize(("cut", "free_elements"), [({}, 8), ({"free_elements": 3}, 3)])
def test_a_sheath_gets_eight_elements_or_as_many_as_are_asked_for(cut, free_elements):
    places, stretching = nodes(Mesh.EULERIAN, sheath=True, elements=10, **cut)
    assert stretching == free_elements
    assert places.size == 10 + free_elements + 1


def test_thin_layers_keep_two_elements_each():
    layers = [
        {"interface": {}, "thickness_mm": 1},
        {"interface": {}, "thickness_mm": 1},
        {"interface": {}},
    ]
    places, _ = nodes(Mesh.EULERIAN, free=0.0, elements=16, tissue=Tissue(layers=layers))
    assert [((places > a) & (places <= b)).sum() for a, b in ((0, 1), (1, 2), (2, 100))] == [2, 2, 12]


def test_an_eulerian_mesh_needs_tissue_to_stand_in():
    with pytest.raises(InvalidValue, match="inserted_mm"):
        nodes(Mesh.EULERIAN, inserted=0.0)


@pytest.mark.parametrize(
    ("written", "meant"),
    [("material", SlipRate.MATERIAL_DERIVATIVE), ("place", SlipRate.SPATIAL_DERIVATIVE)],
)
def test_a_slip_rate_is_accepted_as_a_protocol_writes_it(written, meant):
    assert Discretisation(slip=written).slip is meant
    assert Discretisation(slip=meant).model_dump(mode="json")["slip"] == written


@pytest.mark.parametrize(
    ("field", "bad"), [("elements", 1), ("step_s", 0.0), ("presliding_deg", 6), ("slip", "stuck")]
)
def test_an_impossible_discretisation_is_refused_by_the_name_of_its_field(field, bad):
    with pytest.raises(InvalidValue, match=field):
        Discretisation(**{field: bad})

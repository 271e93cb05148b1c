"""The compiled model carries the constants, and stands on its own in any viewer."""

import math

import mujoco
import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.kernel import memory_map
from sim.kernel.callback import install
from sim.kernel.mesh import XI_LEFT, XI_RIGHT, cover, place_nodes
from sim.kernel.struct_offsets import read_struct_offsets
from sim.spec import Setup, needle_spec

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.01725)


def setup(free=50.0, inserted=150.0, **fields):
    return Setup(needle=NITINOL, tissue=VISCOUS, free_mm=free, inserted_mm=inserted, **fields)


def test_inertia_and_mass_of_the_shaft_are_those_of_the_needle():
    model = needle_spec(setup()).compile()
    shaft = [model.body(f"shaft_{i}").id for i in range(model.nq - 1)]
    about_axis = model.body_inertia[shaft].min(axis=1).sum()
    assert about_axis == pytest.approx(NITINOL.rotary_inertia_kg_m * 0.2)
    mass = 6450 * math.pi / 4 * 0.59e-3**2 * 0.2
    assert model.body_mass[shaft].sum() == pytest.approx(mass)


def test_joint_springs_in_series_are_the_torsion_of_the_whole_shaft():
    model = needle_spec(setup()).compile()
    springs = [model.joint(f"twist_{i}").stiffness[0] for i in range(1, model.nq - 1)]
    whole = 1 / sum(1 / k for k in springs)
    assert whole == pytest.approx(323.5764e-6 / 0.2, rel=1e-6)


def test_capsules_follow_one_another_along_the_shaft():
    model = needle_spec(setup(mesh=Mesh.LAGRANGIAN)).compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    sizes = np.array([model.geom(f"shaft_{i}").size[1] for i in range(model.nq - 1)])
    assert 2 * sizes.sum() == pytest.approx(0.2)
    assert data.site("tip").xpos[0] == pytest.approx(0.2)
    assert np.all(model.geom_type == mujoco.mjtGeom.mjGEOM_CAPSULE)


def test_the_model_stands_and_turns_in_plain_mujoco(tmp_path):
    """Without the callback the servo turns the base, and torsion takes the tip along."""
    path = tmp_path / "needle.xml"
    path.write_text(needle_spec(setup()).to_xml())
    model = mujoco.MjModel.from_xml_path(str(path))
    model.numeric("needle").data[memory_map.H_MAGIC] = 0.0  # not ours: the callback passes
    data = mujoco.MjData(model)
    data.ctrl[:2] = 1.0, 0.01
    mujoco.mj_step(model, data, 100)
    assert data.qpos[0] == pytest.approx(0.01, rel=1e-6)
    assert data.qpos[1] == pytest.approx(1.0, rel=1e-6)
    assert data.qpos[1:].sum() == pytest.approx(1.0, rel=1e-6)


def test_an_angle_servo_is_a_million_times_stiffer_than_the_shaft():
    stiff = setup()
    shaft = NITINOL.rigidity_n_mm2 * 1e-6 / 0.2
    assert stiff.servo_n_m_per_rad == pytest.approx(1e6 * shaft)
    assert setup(drive=Drive(kind=DriveKind.TORQUE)).servo_n_m_per_rad == 0
    assert setup(drive=Drive(stiffness_n_mm_per_rad=5)).servo_n_m_per_rad == pytest.approx(5e-3)


def test_a_mesh_in_layered_tissue_has_nodes_at_the_boundaries():
    layers = [
        {"interface": {"viscous_n_mm_s_per_mm": 0.01}, "thickness_mm": 13},
        {"interface": {"viscous_n_mm_s_per_mm": 0.02}},
    ]
    nodes = Setup(needle=NITINOL, tissue=Tissue(layers=layers), free_mm=50, inserted_mm=100).nodes_mm
    assert 50.0 in nodes
    assert np.abs(nodes - 63.0).min() < 1e-9
    assert nodes[-1] == 150.0


def test_elements_too_light_for_mujoco_are_refused_with_the_way_out():
    thin = NITINOL.but(diameter_mm=0.05)
    with pytest.raises(InvalidValue, match="fewer elements"):
        needle_spec(Setup(needle=thin, tissue=VISCOUS, free_mm=0, inserted_mm=10, mesh=Mesh.EULERIAN))


@pytest.mark.parametrize(
    ("free", "inserted", "field"), [(-1, 10, "free_mm"), (5, math.nan, "inserted_mm"), (0, 0, "some")]
)
def test_impossible_lengths_are_refused(free, inserted, field):
    with pytest.raises(InvalidValue, match=field):
        setup(free=free, inserted=inserted)


def test_offsets_of_mujocos_structs_agree_with_the_bindings():
    layout = read_struct_offsets()  # raises where they do not
    assert layout.data["qpos"] != layout.data["qvel"]


def test_other_models_pass_the_callback_untouched():
    install()
    xml = """<mujoco><custom><numeric name="gains" data="1 2 3"/></custom><worldbody>
      <body><joint type="hinge" stiffness="3"/><geom size=".1" pos=".2 0 0"/></body>
      </worldbody></mujoco>"""
    model = mujoco.MjModel.from_xml_string(xml)
    data = mujoco.MjData(model)
    data.qpos[0] = 0.1
    mujoco.mj_forward(model, data)
    assert data.qfrc_passive == pytest.approx([-0.3])


def _row(top, end):
    row = np.zeros(memory_map.COLUMNS)
    row[memory_map.L_TOP_CONST], row[memory_map.L_END_CONST] = top, end
    return row


@pytest.mark.parametrize(("top", "end"), [(0, 1), (0.25, 1), (0.31, 1), (0.31, 0.33), (0.1, 0.77)])
def test_loads_keep_the_covered_length_and_its_centroid(top, end):
    x = np.linspace(0, 1, 9)
    loads, point = np.zeros((8, 4)), np.zeros(2)
    cover(_row(top, end), x, 0.0, 0.0, True, loads, point)
    assert loads.sum() == pytest.approx(end - top)
    assert loads.min() >= 0
    nodes = (loads[:, :2].sum(axis=1), loads[:, 2:].sum(axis=1))
    moment = nodes[0] @ x[:-1] + nodes[1] @ x[1:]
    assert moment == pytest.approx((end**2 - top**2) / 2)


def test_inside_a_covered_stretch_damping_is_half_lumped_half_consistent():
    x = np.linspace(0, 1, 9)
    loads, point = np.zeros((8, 4)), np.zeros(2)
    cover(_row(0, 1), x, 0.0, 0.0, False, loads, point)
    left, right = loads[4, :2], loads[4, 2:]
    shape_left, shape_right = np.array([XI_RIGHT, XI_LEFT]), np.array([XI_LEFT, XI_RIGHT])
    matrix = np.array(
        [[left @ shape_left, left @ shape_right], [right @ shape_left, right @ shape_right]]
    )
    assert matrix == pytest.approx(np.array([[5, 1], [1, 5]]) / 12 / 8)


def test_a_mesh_fixed_to_the_tissue_stretches_only_its_free_part():
    head = np.zeros(memory_map.HEADER)
    head[memory_map.H_STRETCHING], head[memory_map.H_FREE_REF] = 2, 1.0
    mesh, x = np.array([0, 0.5, 1.0, 1.5, 2.0]), np.zeros(5)
    place_nodes(head, mesh, 1.2, x)
    assert x == pytest.approx([0, 0.6, 1.2, 1.7, 2.2])


def test_siblings_have_the_same_bodies_as_the_chain():
    chain, siblings = (
        needle_spec(setup(discretisation=Discretisation(arrangement=a))).compile() for a in Arrangement
    )
    assert chain.body_inertia == pytest.approx(siblings.body_inertia)
    assert chain.body_mass == pytest.approx(siblings.body_mass)

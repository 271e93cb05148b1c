"""The compiled model carries the constants, and stands on its own in any viewer."""

import math

import mujoco
import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.spec import needle_spec

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


def test_elements_too_light_for_mujoco_are_refused_with_how_to_fix_it():
    thin = NITINOL.but(diameter_mm=0.05)
    with pytest.raises(InvalidValue, match="fewer elements"):
        needle_spec(Setup(needle=thin, tissue=VISCOUS, free_mm=0, inserted_mm=10, mesh=Mesh.EULERIAN))


def test_siblings_have_the_same_bodies_as_the_chain():
    chain, siblings = (
        needle_spec(setup(discretisation=Discretisation(arrangement=a))).compile() for a in Arrangement
    )
    assert chain.body_inertia == pytest.approx(siblings.body_inertia)
    assert chain.body_mass == pytest.approx(siblings.body_mass)

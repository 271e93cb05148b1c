"""Internal variables: what a step leaves behind at nodes and at points of the tissue."""

import numpy as np
import pytest

from validation.rig.memory import POINTS_PER_CELL, commit, interpolate_to_nodes, tissue_point_count
from validation.rig.newton import solve
from validation.rig.state import CHUCK, ENTRY, TIP, StepInput


def test_an_eulerian_mesh_has_its_nodes_as_points_of_the_tissue(step):
    made = step()
    assert tissue_point_count(made.mesh, 100.0, 60.0) == made.mesh.nodes
    values, nodes = np.arange(float(made.mesh.nodes)), np.zeros(made.mesh.nodes)
    interpolate_to_nodes(made.mesh, made.chain, values, nodes)
    assert (nodes == values).all()


def test_a_lagrangian_mesh_has_points_down_to_the_greatest_depth(step):
    made = step(lagrangian=True, cells=10)
    spacing = 10.0 / POINTS_PER_CELL
    count = tissue_point_count(made.mesh, 100.0, 60.0)
    assert count * spacing >= 60.0
    depths = (np.arange(count) + 0.5) * spacing
    nodes = np.zeros(made.mesh.nodes)
    interpolate_to_nodes(made.mesh, made.chain, 3.0 * depths + 1.0, nodes)
    inside = made.chain.depth > spacing / 2
    assert nodes[inside] == pytest.approx(3.0 * made.chain.depth[inside] + 1.0)  # linear: exact


def done(made, step_s=0.01):
    assert solve(made.law, made.chain, made.state, made.inputs, made.work)
    past = np.zeros_like(made.state.tissue_twist)
    arguments = (made.law, made.mesh, made.chain, made.state, made.work, made.inputs)
    commit(*arguments, past, (step_s, 60.0))
    return made


def test_presliding_follows_the_turn_and_stops_at_its_limit(step):
    made = done(step(base=1e-4, coulomb=0.004, entry=0.1, load=0.4))
    moved = made.chain.tissue > 0
    assert made.state.presliding[moved] == pytest.approx(made.work.angle[moved])
    assert made.state.lumped[[ENTRY, TIP]] == pytest.approx(made.work.angle[[0, -1]])
    made.inputs = StepInput(3.0, 0.0, 100.0, 0.0, 0.0, 0.0)
    done(made)
    assert (made.state.presliding[moved] == made.law.limit).all()
    assert (made.state.angle_before[moved] < 1e-4).all()


def test_age_grows_with_rest_and_wear_with_slip(step):
    rested = done(step(), step_s=2.0)
    moved = rested.chain.tissue > 0
    assert (rested.state.age[moved] == 2.0).all()
    assert (rested.state.worn == 0.0).all()
    turned = done(step(base=0.35), step_s=2.0)
    assert turned.state.worn[moved] == pytest.approx(turned.work.angle[moved])
    assert (turned.state.age[moved] < 2.0).all()


def test_links_that_yield_remember_their_set(step):
    made = done(step(base=0.35, yield_torque=0.1, yield_slope=0.5))
    torque = made.chain.link[0] * (0.35 - made.work.angle[0] - made.state.set_twist[0])
    assert torque - 0.5 * made.chain.link[0] * made.state.set_twist[0] == pytest.approx(0.1)
    assert not done(step(base=0.35)).state.set_twist.any()


def test_a_chuck_that_slips_remembers_how_far(step):
    made = done(step(base=0.35, grip=0.1))
    assert made.state.lumped[CHUCK] > 0.01
    assert done(step(base=0.35)).state.lumped[CHUCK] == 0.0


@pytest.mark.parametrize("lagrangian", [False, True])
def test_tissue_that_yields_twists_in_proportion_to_its_torque(step, lagrangian):
    made = done(step(base=0.35, lagrangian=lagrangian, compliance=20.0, retardation=0.5))
    nodes = np.zeros(made.mesh.nodes)
    interpolate_to_nodes(made.mesh, made.chain, made.state.tissue_twist, nodes)
    covered = made.chain.tissue == made.chain.tissue.max()
    expected = 20.0 * made.work.torque / (1 + 0.5 * made.inputs.lead)
    # Where the mesh is Lagrangian, points lie between nodes: linear interpolation, second order.
    assert nodes[covered] == pytest.approx(expected[covered], rel=0.05 if lagrangian else 1e-6)
    assert (expected[covered] != 0).all()

"""The chain of finite volumes: no length, stiffness or damping is lost or invented."""

import numpy as np
import pytest

from validation.rig.mesh import assemble

FREE, INSERTED = 40.0, 60.0  # of the fixture `step`, mm
MESHES = [{}, {"sheath": 4}, {"lagrangian": True, "cells": 10}]
ROUNDING = 1e-12  # relative: sums of some ten terms in double precision


@pytest.mark.parametrize("mesh", MESHES)
def test_links_add_up_to_the_needle(step, mesh):
    made = step(**mesh)
    assert made.chain.link_mm.sum() == pytest.approx(FREE + INSERTED, rel=ROUNDING)
    compliance = (1 / made.chain.link[:-1]).sum()
    assert compliance == pytest.approx((FREE + INSERTED) / made.law.rigidity, rel=ROUNDING)


@pytest.mark.parametrize("mesh", MESHES)
def test_tissue_covers_the_inserted_length_and_the_sheath_the_free_one(step, mesh):
    chain = step(**mesh).chain
    assert chain.tissue.sum() == pytest.approx(INSERTED, rel=ROUNDING)
    assert chain.sheath.sum() == pytest.approx(FREE if mesh else 0.0, rel=ROUNDING)
    assert chain.depth[-1] == INSERTED


@pytest.mark.parametrize("mesh", MESHES)
@pytest.mark.parametrize("law", [{"ratio": 4.0, "boundary": 0.43}, {"gradient": 0.6}])
def test_layers_and_gradients_keep_the_mean_damping(step, mesh, law):
    made = step(**mesh, **law)
    total = (made.chain.damping * made.chain.tissue).sum()
    assert total == pytest.approx(made.law.damping * INSERTED, rel=ROUNDING)
    assert np.ptp(made.chain.damping[made.chain.tissue > 0]) > 0.1 * made.law.damping


@pytest.mark.parametrize("mesh", MESHES)
def test_the_entry_is_shared_out_whole_and_at_its_place(step, mesh):
    chain = step(**mesh).chain
    assert chain.entry.sum() == pytest.approx(1.0, rel=ROUNDING)
    positions = np.cumsum(chain.link_mm)
    assert chain.entry @ positions == pytest.approx(FREE, rel=ROUNDING)


def test_a_lagrangian_mesh_takes_the_passing_point_from_the_middle_of_the_step(step):
    made = step(lagrangian=True, cells=10)
    assemble(made.chain, made.law, made.mesh, 38.0, 39.0, 62.0)
    positions = np.cumsum(made.chain.link_mm)
    assert made.chain.entry @ positions == pytest.approx(38.0, rel=ROUNDING)
    assert made.chain.passing @ positions == pytest.approx(39.0, rel=ROUNDING)

"""Nodes, and how tissue along an element loads them."""

import numpy as np
import pytest

from sim.kernel import memory_map
from sim.kernel.mesh import XI_LEFT, XI_RIGHT, cover, place_nodes


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


@pytest.mark.parametrize(("middle", "covered"), [(0.6, 0.4), (0.35, 0.25), (0.2, 0.1), (0.05, 0.0)])
def test_what_begins_in_the_tissue_does_not_reach_out_of_it(middle, covered):
    """A section of 0.4 about a place of a shaft whose first 0.3 are free."""
    free = 0.3
    row = _row(middle - 0.2 - free, middle + 0.2 - free)
    row[[memory_map.L_TOP_FREE, memory_map.L_END_FREE]] = 1.0
    loads, point = np.zeros((8, 4)), np.zeros(2)
    cover(row, np.linspace(0, 1, 9), free, 0.7, True, loads, point)
    assert loads.sum() == pytest.approx(covered)

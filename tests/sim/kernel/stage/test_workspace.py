"""The workspace is cut from one piece of memory, without overlap."""

import numpy as np
import pytest


@pytest.mark.parametrize(("n", "rows"), [(2, 1), (16, 3)])
def test_the_arrays_are_views_that_share_no_value(interpreted, n, rows):
    """`sim.kernel.stage.workspace` in the interpreter."""
    size = interpreted.memory_map.scratch(n, rows) - 4 * (n + 1)  # angles, rates, inertia, springs
    memory, end = np.zeros(size), np.zeros((rows, n, 2, interpreted.memory_map.SITE))
    workspace = interpreted.workspace.divide(memory, n, rows, end)
    for array in workspace:
        assert np.all(array == 0.0)  # nobody wrote here yet
        array[:] = 1.0
    assert np.all(memory[: sum(a.size for a in workspace[:-1])] == 1.0)
    assert sum(a.size for a in workspace[:-1]) <= size
    assert workspace.end is end


def test_shapes_are_those_of_nodes_elements_and_sites(interpreted):
    n, rows, sites = 4, 2, interpreted.memory_map.SITE
    memory = np.zeros(interpreted.memory_map.scratch(n, rows))
    w = interpreted.workspace.divide(memory, n, rows, np.zeros((rows, n, 2, sites)))
    assert w.omega.shape == w.diagonal.shape == w.x.shape == (n + 1,)
    assert w.loads.shape == (rows, n, 4)
    assert w.start.shape == w.end.shape == (rows, n, 2, sites)

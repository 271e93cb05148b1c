"""Parts of a piece of memory, compiled and interpreted."""

import numpy as np
import pytest
from numba import njit

from sim.kernel.view import view

# A compiled function without counted references may return no array that it made.


@njit(_nrt=False)
def doubled(memory, start, n):
    part = view(memory, start, (2, n))
    for i in range(2):
        for j in range(n):
            part[i, j] *= 2.0
    return part.size, part.shape[1], part.strides[0], part[1, 0]


def test_a_compiled_part_is_the_memory_itself():
    memory = np.arange(10.0)
    assert doubled(memory, 3, 3) == (6, 3, 24, 12.0)
    assert memory.tolist() == [0, 1, 2, 6, 8, 10, 12, 14, 16, 9]


@pytest.mark.parametrize("shape", [(4,), (2, 3), (1, 2, 2, 2)])
def test_the_interpreted_part_is_that_of_numpy(interpreted, shape):
    memory = np.arange(12.0)
    part = interpreted.view.view(memory, 2, shape)
    assert part.shape == shape
    assert part.ravel().tolist() == list(range(2, 2 + part.size))
    part[...] = -1.0
    assert memory[2] == -1.0

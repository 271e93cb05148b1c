"""Addresses of arrays, read by compiled code."""

import numpy as np
import pytest
from numba import njit

from sim.kernel.native.pointers import addresses, flags, numbers


@pytest.mark.parametrize(
    ("pointer", "values"),
    [
        (numbers, np.array([0.5, -2.0, 1e300])),
        (addresses, np.array([1, 2**40, 7], dtype=np.intp)),
        (flags, np.array([True, False, True])),
    ],
)
def test_an_address_reads_as_the_array_that_is_there(pointer, values):
    read = njit(lambda address, i: pointer(address)[i])
    assert [read(values.ctypes.data, i) for i in range(3)] == values.tolist()


def test_what_is_written_through_a_pointer_is_in_the_array():
    @njit
    def write(address):
        numbers(address)[1] = 7.0

    values = np.zeros(3)
    write(values.ctypes.data)
    assert values.tolist() == [0.0, 7.0, 0.0]

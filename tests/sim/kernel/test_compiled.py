"""What the compilers of kernel functions promise: Python's values, and C's division."""

import math

import pytest

from sim.kernel.compiled import embedded, inlined


def weighted(a, b):
    return a / b + math.exp(-a * a)


@pytest.mark.parametrize("compiler", [inlined, embedded])
def test_a_compiled_function_gives_the_value_of_the_source(compiler):
    # one rounding may differ where a product and a sum are contracted
    assert compiler(weighted)(0.7, 0.3) == pytest.approx(weighted(0.7, 0.3), rel=4e-16)


def test_a_division_by_zero_gives_infinity_as_in_c():
    with pytest.raises(ZeroDivisionError):
        weighted(1.0, 0.0)
    assert embedded(weighted)(1.0, 0.0) == math.inf

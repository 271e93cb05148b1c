"""Conditions of order and stability of the methods of a step, from the table that the kernel reads."""

import numpy as np
import pytest

ORDERS = pytest.mark.parametrize("order", [1, 2, 3])


def butcher(method, order):
    """A and c: slopes k of the stages give y_i = y0 + h sum of a_ij k_j."""
    gamma, stages = method.GAMMAS[order - 1], method.STAGES[order - 1]
    slopes, start = np.zeros((order, order)), np.zeros(order)
    for i in range(order):
        slopes[i] = start
        slopes[i, i] += gamma
        start = stages[i, method.KEPT] * start + stages[i, method.CARRIED] * (slopes[i] - start)
    return slopes, stages[:order, method.REACH]


@ORDERS
def test_a_method_is_of_the_order_that_it_is_named_by(interpreted, order):
    slopes, reach = butcher(interpreted.method, order)
    weights = slopes[-1]
    conditions = [
        weights.sum() - 1,
        weights @ reach - 1 / 2,
        weights @ reach**2 - 1 / 3,
        weights @ slopes @ reach - 1 / 6,
    ]
    kept = (1, 2, 4)[order - 1]
    assert conditions[:kept] == pytest.approx([0.0] * kept, abs=1e-14)
    assert max(map(abs, conditions[kept:]), default=1.0) > 1e-3  # and of no higher one


@ORDERS
def test_stages_end_where_they_say_and_share_the_step(interpreted, order):
    method = interpreted.method
    slopes, reach = butcher(method, order)
    assert slopes.sum(axis=1) == pytest.approx(reach, abs=1e-14)
    assert reach[-1] == 1.0  # stiffly accurate: the last stage is the end of the step
    assert method.STAGES[order - 1, :order, method.SHARE] == pytest.approx(slopes[-1], abs=1e-14)


@ORDERS
def test_a_method_is_l_stable(interpreted, order):
    """|1 + z b (1 - z A)^-1 1| is at most 1 on the imaginary axis, and vanishes at infinity."""
    slopes, _ = butcher(interpreted.method, order)

    def growth(z):
        return abs(1 + z * slopes[-1] @ np.linalg.solve(np.eye(order) - z * slopes, np.ones(order)))

    assert max(growth(1j * w) for w in np.geomspace(1e-3, 1e3, 200)) < 1 + 1e-12
    assert growth(-1e9) < 1e-6

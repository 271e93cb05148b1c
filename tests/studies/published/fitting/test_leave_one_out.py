"""The fit without one figure."""

import numpy as np
import pytest

from studies.published.fitting.leave_one_out import vector_without

BOUNDS = (np.array([-10.0]), np.array([10.0]))


def test_in_a_linear_model_the_step_is_the_fit_to_the_others():
    depth, value = np.array([1.0, 2.0, 3.0]), np.array([1.2, 1.8, 3.3])
    x = depth @ value / (depth @ depth)
    moved = vector_without(2, np.array([x]), depth * x - value, depth[:, None], BOUNDS)
    assert moved == pytest.approx([(1.0 * 1.2 + 2.0 * 1.8) / 5.0])


def test_the_step_stays_within_bounds_and_within_the_longest_step():
    # Without figure 1 the minimum is at 5: one unit is as far as a linear step goes.
    residual, jacobian = np.array([-5.0, 0.0]), np.array([[1.0], [1.0]])
    assert vector_without(1, np.zeros(1), residual, jacobian, BOUNDS) == pytest.approx([1.0])
    near = (np.array([0.0]), np.array([0.25]))
    assert vector_without(1, np.zeros(1), residual, jacobian, near) == pytest.approx([0.25])

"""What an effect changes, beside what a fit could take back."""

import numpy as np
import pytest
from diagnosis_fixtures import held_by_a_bound
from scipy.optimize import lsq_linear

from diagnosis.fitting.projection import Projection


@pytest.fixture(scope="module")
def fit():
    """Far beyond its bound: much is left that the parameters cannot take off."""
    return held_by_a_bound(2.0)


def test_what_lies_beyond_a_bound_is_not_promised(fit):
    slopes, residual = np.vstack(fit.jacobian), np.concatenate(fit.by_trial)
    without_bounds = lsq_linear(slopes, -residual).cost * 2
    assert without_bounds < 0.6 * fit.cost
    assert Projection(fit, "tip_drag").reachable().cost == pytest.approx(fit.cost, rel=1e-3)


@pytest.mark.parametrize("sign", [1, -1])
def test_reachable_cost_is_that_of_the_least_squares_of_everything_at_once(fit, sign):
    """By another algorithm. An effect may be there, or not, but not be there negatively."""
    low, high = (bound - fit.x for bound in fit.parameterization.bounds())
    slopes, residual = np.vstack(fit.jacobian), np.concatenate(fit.by_trial)
    d = sign * np.random.default_rng(5).normal(size=residual.size) - sign * 0.3 * residual
    system = np.column_stack([slopes, d])
    room = [np.append(low - 1e-9, 0.0), np.append(high + 1e-9, np.inf)]
    least = 2 * lsq_linear(system, -residual, bounds=room, method="trf", tol=1e-12).cost
    moved = np.split(residual + d, len(fit.by_trial))
    found = Projection(fit, "tip_drag").reachable(moved)
    assert found.cost == pytest.approx(least, rel=1e-3)
    # It tells where that is: as far along the slopes, and so much of the difference.
    left = residual + slopes @ found.step + found.scale * d
    assert left @ left == pytest.approx(least, rel=1e-3)
    assert (found.scale > 0.0) == (sign > 0)


def test_what_is_beyond_a_fit_is_what_least_squares_leave(fit):
    slopes, residual = np.vstack(fit.jacobian), np.concatenate(fit.by_trial)
    d = slopes @ [0.3, -0.2, 0.1] + np.random.default_rng(6).normal(size=residual.size)
    taken_back = slopes @ np.linalg.lstsq(slopes, d)[0]
    beyond = Projection(fit, "tip_drag").beyond(np.split(residual + d, len(fit.by_trial)))
    np.testing.assert_allclose(beyond[: d.size], d - taken_back, atol=1e-8)
    np.testing.assert_allclose(slopes.T @ beyond[: d.size], 0.0, atol=1e-6)


def test_nothing_is_left_of_what_the_fit_could_take_back(fit):
    moved = np.concatenate(fit.by_trial) + np.vstack(fit.jacobian) @ [0.3, -0.2, 0.1]
    beyond = Projection(fit, "tip_drag").beyond(np.split(moved, len(fit.by_trial)))
    np.testing.assert_allclose(beyond, 0.0, atol=1e-8)


def test_the_answered_cost_is_what_least_squares_leave_of_other_residuals(fit):
    slopes, residual = np.vstack(fit.jacobian), np.concatenate(fit.by_trial)
    other = residual + np.random.default_rng(7).normal(size=residual.size)
    left = other - slopes @ np.linalg.lstsq(slopes, other)[0]
    found = Projection(fit, "tip_drag").answered_cost(np.split(other, len(fit.by_trial)))
    assert found == pytest.approx(left @ left)

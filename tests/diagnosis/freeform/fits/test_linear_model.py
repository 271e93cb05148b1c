"""What a fit cannot take off, against least squares of the whole system."""

import numpy as np
import pytest
from free_forms import family_of, linear_fit

from diagnosis.freeform.fits.linear_model import linear_model

SAMPLES = 300


@pytest.fixture
def fit():
    """A fit whose columns differ by six decades, one of which is nothing."""
    rng = np.random.default_rng(4)
    family = family_of()
    size = len(family.effect.parameters)
    slopes = rng.normal(size=(SAMPLES, size)) * np.geomspace(1e-3, 1e3, size)
    slopes[:, 2] = 0.0
    return linear_fit(family, [slopes], [rng.normal(size=SAMPLES)], x=rng.normal(size=size))


def left_by(matrix, residual):
    x = np.linalg.lstsq(matrix, residual)[0]
    return residual - matrix @ x


def test_the_cost_that_is_left_is_that_of_least_squares(fit):
    left = left_by(fit.slopes, fit.residual)
    assert linear_model(fit).cost == pytest.approx(left @ left, rel=1e-6)


def test_beyond_the_slopes_changes_are_what_least_squares_leave_of_them(fit):
    rng = np.random.default_rng(5)
    changes = rng.normal(size=(SAMPLES, 3))
    changes[:, 1] += fit.jacobian[0][:, 5] / np.linalg.norm(fit.jacobian[0][:, 5])
    whole = np.vstack([changes, np.zeros((fit.x.size, 3))])  # the prior does not change
    beyond = np.column_stack([left_by(fit.slopes, column) for column in whole.T])
    squares, along = linear_model(fit).beyond(changes)
    np.testing.assert_allclose(squares, beyond.T @ beyond, rtol=1e-6, atol=1e-6 * SAMPLES)
    np.testing.assert_allclose(along, beyond.T @ fit.residual, atol=1e-6 * SAMPLES)


def test_of_columns_that_are_alike_one_is_enough(fit):
    twice = np.column_stack([fit.jacobian[0], fit.jacobian[0]])
    family = family_of(parameters=2 * [*family_of().effect.parameters])
    same = linear_fit(family, [twice], [np.zeros(SAMPLES)], x=np.zeros(twice.shape[1]))
    squares, _ = linear_model(same).beyond(fit.jacobian[0][:, 5:7])
    size = np.sum(fit.jacobian[0][:, 5:7] ** 2, axis=0)
    assert (np.diag(squares) < 1e-3 * size).all()  # but for the prior, which is weak here

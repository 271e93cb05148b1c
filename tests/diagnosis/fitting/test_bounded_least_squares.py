"""Linear least squares within bounds."""

import numpy as np
import pytest
from scipy.optimize import lsq_linear

from diagnosis.fitting.bounded_least_squares import bounded_least_squares, predicted_reduction


@pytest.fixture
def system():
    """Two columns that look alike, and what a third of the first alone would give."""
    rng = np.random.default_rng(1)
    matrix = rng.normal(size=(200, 3))
    matrix[:, 1] = matrix[:, 0] + 0.1 * matrix[:, 1]
    return matrix, matrix @ [1.0, 1.0, 1.0] + rng.normal(size=200)


def test_the_least_squares_are_those_of_another_algorithm(system):
    low, high = np.array([-1.0, -1.0, -1.0]), np.array([0.4, 5.0, 5.0])
    found = bounded_least_squares(*system, low, high)
    other = lsq_linear(*system, bounds=(low, high), method="trf", tol=1e-14).x
    np.testing.assert_allclose(found, other, atol=1e-5)
    assert found[0] == high[0]


def test_where_one_entry_is_held_others_move_less_or_more_than_clipping_says(system):
    low, high = np.full(3, -5.0), np.array([0.4, 5.0, 5.0])
    free = np.linalg.lstsq(*system)[0]
    found = bounded_least_squares(*system, low, high)
    assert abs(found[1] - np.clip(free, low, high)[1]) > 0.1


def test_an_entry_without_room_stays(system):
    found = bounded_least_squares(*system, np.array([0.0, -5.0, -5.0]), np.array([0.0, 5.0, 5.0]))
    assert found[0] == 0.0


def test_nothing_to_move_is_no_step():
    assert bounded_least_squares(np.zeros((5, 0)), np.ones(5), np.zeros(0), np.zeros(0)).size == 0


def test_what_is_promised_is_what_the_least_squares_take_off(system):
    matrix, wanted = system
    low, high = np.array([-1.0, -1.0, -1.0]), np.array([0.4, 5.0, 5.0])
    x = bounded_least_squares(matrix, wanted, low, high)
    taken = wanted @ wanted - np.sum((matrix @ x - wanted) ** 2)
    assert predicted_reduction(matrix, -wanted, low, high) == pytest.approx(taken)
    assert predicted_reduction(matrix, matrix @ x - wanted, low - x, high - x) == pytest.approx(
        0.0, abs=1e-6
    )

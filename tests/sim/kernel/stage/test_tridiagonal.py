"""Thomas' algorithm against a dense solution."""

import numpy as np
import pytest

from sim.kernel.stage import tridiagonal  # compiled: two loops


def system(n, seed):
    rng = np.random.default_rng(seed)
    lower, upper = rng.normal(size=(2, n))
    diagonal = 2.0 + np.abs(lower) + np.abs(upper)
    return lower, diagonal, upper, rng.normal(size=n)


def dense(lower, diagonal, upper):
    return np.diag(diagonal) + np.diag(lower[1:], -1) + np.diag(upper[:-1], 1)


@pytest.mark.parametrize("n", [2, 3, 40])
def test_the_solution_is_that_of_the_dense_matrix(n):
    lower, diagonal, upper, rhs = system(n, seed=n)
    expected = np.linalg.solve(dense(lower, diagonal, upper), rhs)
    tridiagonal.factorise(lower, diagonal, upper)
    tridiagonal.substitute(lower, diagonal, upper, rhs)
    # Dominant rows: the condition is below 3, rounding below n eps.
    assert rhs == pytest.approx(expected, rel=1e-13, abs=1e-14)


def test_factors_serve_a_second_right_hand_side():
    lower, diagonal, upper, rhs = system(8, seed=1)
    matrix = dense(lower, diagonal, upper)
    tridiagonal.factorise(lower, diagonal, upper)
    for other in (rhs, np.arange(8.0)):
        solution = other.copy()
        tridiagonal.substitute(lower, diagonal, upper, solution)
        assert matrix @ solution == pytest.approx(other, abs=1e-13)


def test_without_factors_the_substitution_is_wrong():
    """Negative control."""
    lower, diagonal, upper, rhs = system(8, seed=2)
    solution = rhs.copy()
    tridiagonal.substitute(lower, diagonal, upper, solution)
    assert np.abs(dense(lower, diagonal, upper) @ solution - rhs).max() > 0.1


@pytest.mark.parametrize("seed", range(5))
def test_of_a_matrix_that_is_not_definite_comes_a_direction_of_descent(seed):
    lower, diagonal, upper, rhs = system(8, seed)
    upper[:-1] = lower[1:]  # symmetric
    diagonal[3] = -diagonal[3]
    matrix = dense(lower, diagonal, upper)
    assert np.linalg.eigvalsh(matrix).min() < 0.0
    assert not tridiagonal.factorise(lower, diagonal, upper)
    step = rhs.copy()
    tridiagonal.substitute(lower, diagonal, upper, step)
    assert rhs @ step > 0.0
    assert rhs @ np.linalg.solve(matrix, rhs) < rhs @ step  # Newton's own step descends less, or not


def test_a_definite_matrix_is_told_from_one_that_is_not():
    assert tridiagonal.factorise(*system(8, seed=3)[:3])

"""Poles of known matrices are found again, whatever the method of the step."""

import numpy as np
import pytest
from scipy.linalg import expm

from studies.crosscheck import identification

# dx/dt = A x of a chain of six: free at both ends, so that one pole is 0.
CHAIN = -(np.diff(np.eye(6), axis=0).T @ np.diff(np.eye(6), axis=0))
SLOW = np.sort(np.linalg.eigvalsh(CHAIN))[::-1][1:4]


def released(step):
    """Angles after each step of x' = step(h) x."""

    def release(step_s, steps):
        return np.array([np.linalg.matrix_power(step(step_s), k + 1) for k in range(steps)])

    return release


@pytest.mark.parametrize(
    ("step", "pole_of"),
    [
        (lambda h: expm(CHAIN * h), identification.pole_of_exact_step),
        (lambda h: np.linalg.inv(np.eye(6) - h * CHAIN), identification.pole_of_backward_euler),
    ],
    ids=["exact", "backward Euler"],
)
def test_the_slow_poles_other_than_0_are_found(step, pole_of):
    found = identification.slow_poles_rad_s(
        released(step), pole_of, count=3, resolution=0.3, guess_s=0.1
    )
    assert found == pytest.approx(SLOW, rel=1e-9)


def test_the_wrong_method_of_the_step_shows():
    """Backward Euler read as exact: ln(1 + x) / x = 1 - x / 2 + ..., with x = |p| h."""
    backward = released(lambda h: np.linalg.inv(np.eye(6) - h * CHAIN))
    found = identification.slow_poles_rad_s(
        backward, identification.pole_of_exact_step, count=3, resolution=0.3, guess_s=0.01
    )
    assert np.all(found / SLOW < 1 - 0.3 * (SLOW / SLOW[-1]) / 3)

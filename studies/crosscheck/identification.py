"""Poles identified from the steps of a simulator.

In one run per node, that node is twisted by a small angle and released. With the angles after
k steps as columns of X_k, the map from one step to the next is X_{k+1} X_k^{-1}; its
eigenvalues z belong to the poles p of the motion. The matrices of the chain are not used: only
the relation between z and p that the method of the step has,

    exact in time               z = exp(p h)
    backward Euler              z = 1 / (1 - p h)
"""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Release = Callable[[float, int], Array]
"""Step, s, and number of steps -> angles after each, (steps, nodes, releases)."""
PoleOfMultiplier = Callable[[Array, float], Array]
"""Eigenvalues z of a step, and its length, s -> poles, rad/s."""

_SETTLING = 2  # steps before the map is read: inertia forgets that it was at rest


def pole_of_exact_step(multiplier: Array, step_s: float) -> Array:
    """Pole of an eigenvalue if the step is exact in time, or its error is negligible."""
    pole: Array = np.log(multiplier) / step_s
    return pole


def pole_of_backward_euler(multiplier: Array, step_s: float) -> Array:
    """Pole of an eigenvalue of backward Euler's step, free of the step's error."""
    return (1.0 - 1.0 / multiplier) / step_s


def slow_poles_rad_s(
    release: Release,
    pole_of: PoleOfMultiplier,
    *,
    count: int,
    resolution: float,
    guess_s: float,
) -> Array:
    """The slowest `count` poles other than 0, rad/s, slowest first.

    Args:
      resolution: step / time constant of the fastest of these poles.
      guess_s: a step with which that time constant is found roughly.
    """
    rough = _poles(release, pole_of, guess_s)[:count]
    return _poles(release, pole_of, resolution / abs(float(rough[-1])))[:count]


def _poles(release: Release, pole_of: PoleOfMultiplier, step_s: float) -> Array:
    angles = release(step_s, _SETTLING + 2)
    step = np.linalg.solve(angles[-2].T, angles[-1].T).T
    multipliers = np.linalg.eigvals(step)
    real = np.sort(multipliers.real[(np.abs(multipliers.imag) < 1e-9) & (multipliers.real > 1e-3)])[::-1]
    poles = pole_of(real, step_s)
    return poles[poles < -1e-6 / step_s]

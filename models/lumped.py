"""The paper's lumped needle: equations (3) and (4).

m equal masses, free at both ends; torsional stiffness kappa / l_s between neighbours (the
paper's K divided by the length l_s of an element); damping b / m on each. Every pole is that
of the continuous needle times (sin x / x)^2, x = k pi / 2m.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigvalsh_tridiagonal

from models.modes import InsertedNeedle

Array = NDArray[np.float64]


def stiffness_n_mm(needle: InsertedNeedle, masses: int) -> Array:
    """K, N mm / rad, (m, m): equation (4)."""
    spring = needle.needle.rigidity_n_mm2 * masses / needle.inserted_mm
    diagonal = np.full(masses, 2.0)
    diagonal[[0, -1]] = 1.0
    beside = np.full(masses - 1, -1.0)
    matrix: Array = spring * (np.diag(diagonal) + np.diag(beside, 1) + np.diag(beside, -1))
    return matrix


def poles_rad_s(needle: InsertedNeedle, *, masses: int, count: int) -> Array:
    """The slowest `count` poles of (3), rad/s, slowest first, including the free turn (0).

    Inertia is kept, although it shifts each by less than a part in 10^6 (Section III-E): a pole is
    the slow root of (eta l_s) s^2 + d s + k_i = 0.
    """
    spring = needle.needle.rigidity_n_mm2 * masses / needle.inserted_mm
    diagonal = np.full(masses, 2.0)
    diagonal[[0, -1]] = 1.0
    stiffness = spring * eigvalsh_tridiagonal(
        diagonal, np.full(masses - 1, -1.0), select="i", select_range=(0, count - 1)
    )
    stiffness[0] = 0.0
    damping = needle.damping_n_mm_s / masses
    inertia = needle.needle.rotary_inertia_kg_m * needle.inserted_mm / masses
    slow: Array = -2 * stiffness / (damping + np.sqrt(damping**2 - 4 * inertia * stiffness))
    return slow

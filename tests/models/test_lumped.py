"""The lumped needle against the continuous one."""

import numpy as np
import pytest

from models import lumped
from models.drive import DriveKind
from models.modes import InsertedNeedle
from models.needle import NITINOL

BETA = 0.01725


def held(length=200.0, free=0.0, drive=DriveKind.ANGLE):
    return InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=length, free_mm=free, drive=drive
    )


def test_lumped_poles_are_the_continuous_ones_times_sinc_squared():
    needle, masses = held(drive=DriveKind.TORQUE), 64
    x = np.arange(1, 5) * np.pi / (2 * masses)
    expected = needle.poles_rad_s(5)[1:] * (np.sin(x) / x) ** 2
    # inertia moves the slow poles by less than 1e-6
    assert lumped.poles_rad_s(needle, masses=masses, count=5)[1:] == pytest.approx(expected, rel=1e-6)


def test_the_lumped_stiffness_is_equation_4():
    matrix = lumped.stiffness_n_mm(held(), 5)
    assert matrix.sum(axis=1) == pytest.approx(np.zeros(5))
    assert matrix[0, 0] == pytest.approx(-matrix[0, 1])
    assert matrix[2, 2] == pytest.approx(2 * matrix[0, 0])


def test_the_poles_are_those_of_the_lumped_stiffness():
    """Without inertia: minus the eigenvalues of K over the damping of one mass."""
    needle, masses = held(drive=DriveKind.TORQUE), 12
    stiffness = np.linalg.eigvalsh(lumped.stiffness_n_mm(needle, masses))
    expected = -stiffness[:4] / (needle.damping_n_mm_s / masses)
    # inertia moves the slow poles by less than 1e-6; the free turn is 0 to rounding
    assert lumped.poles_rad_s(needle, masses=masses, count=4) == pytest.approx(
        expected, rel=1e-5, abs=1e-9
    )

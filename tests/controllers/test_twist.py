"""The modal model of the shaft against quadrature and sums."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from controllers.twist import Twist
from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import NITINOL


def test_the_stretch_of_the_modes_is_the_integral_that_it_stands_for():
    g = Twist(NITINOL, 5).stretch

    def entry(k, j):
        pi = math.pi
        return quad(lambda s: 2 * j * pi * s * math.sin(j * pi * s) * math.cos(k * pi * s), 0, 1)[0]

    expected = [[entry(k, j) for j in range(1, 5)] for k in range(1, 5)]
    assert g == pytest.approx(np.array(expected), abs=1e-9)


def test_the_poles_are_those_of_the_torque_driven_needle():
    held = InsertedNeedle(
        needle=NITINOL, damping_n_mm_s_per_mm=0.017, inserted_mm=80.0, drive=DriveKind.TORQUE
    )
    assert Twist(NITINOL, 4).poles(80.0, 0.017) == pytest.approx(held.poles_rad_s(4)[1:])


@pytest.mark.parametrize("order", [2, 4, 7])
def test_kept_modes_and_tail_hold_the_whole_static_lag(order):
    """At a steady turn mode k is (-1)^k 2 u l / (kappa (k pi)^2), and the lag u l / (2 kappa)."""
    twist, torque, length = Twist(NITINOL, order), 0.8, 90.0
    modes = twist.sign * 2 * torque * length / (twist.kappa * (twist.k * np.pi) ** 2)
    lag = 2 * modes[twist.odd].sum() + twist.tail_rad(torque, length)
    assert lag == pytest.approx(-torque * length / (2 * twist.kappa))


def test_one_mode_alone_is_refused():
    with pytest.raises(InvalidValue, match="order"):
        Twist(NITINOL, 1)

"""Steady twist: equations (1) and (2) against the integral of the torque along the shaft."""

import math

import numpy as np
import pytest
from scipy.integrate import quad

from models import published
from models.errors import InvalidValue
from models.lag import lag_deg, level_n_mm_per_mm, shear_modulus_gpa, steady_lag_deg, twist_deg
from models.needle import NITINOL


def test_the_lag_of_simtest_follows_from_equation_2():
    lag = lag_deg(NITINOL, base_torque_n_mm=1.0, free_mm=230, inserted_mm=100)
    assert lag == pytest.approx(49.6, abs=0.05)


def test_level_from_lag_is_the_inverse_of_lag_from_torque():
    level = level_n_mm_per_mm(NITINOL, lag_deg=12.0, free_mm=80, inserted_mm=60)
    back = lag_deg(NITINOL, base_torque_n_mm=level * 60, free_mm=80, inserted_mm=60)
    assert back == pytest.approx(12.0)


def test_a_steady_turn_lags_in_proportion_to_its_rate():
    lengths = {"damping_n_mm_s_per_mm": 0.017, "free_mm": 50, "inserted_mm": 100}
    one, two = (steady_lag_deg(NITINOL, rate_rad_s=r, **lengths) for r in (0.1, 0.2))
    assert two == pytest.approx(2 * one)


def test_the_lag_is_the_integral_of_a_torque_that_falls_to_zero_at_the_tip():
    torque, free, inserted = 0.7, 80.0, 60.0

    def carried(x):
        return torque * (1.0 if x < free else 1.0 - (x - free) / inserted)

    twist, _ = quad(carried, 0, free + inserted, points=[free])
    lag = lag_deg(NITINOL, base_torque_n_mm=torque, free_mm=free, inserted_mm=inserted)
    assert lag == pytest.approx(math.degrees(twist / NITINOL.rigidity_n_mm2))


def test_the_twist_test_gives_the_shear_modulus_back():
    angle = twist_deg(NITINOL, torque_n_mm=1.24, length_mm=410.0)
    modulus = shear_modulus_gpa(diameter_mm=0.59, torque_n_mm=1.24, length_mm=410.0, twist_deg=angle)
    assert modulus == pytest.approx(27.2)
    assert angle == pytest.approx(published.TWIST_TEST_ANGLE.value, rel=2e-3)  # three digits printed


def test_a_steady_turn_carries_the_damping_of_its_inserted_length():
    rate, lengths = np.radians(4.5), {"free_mm": 50.0, "inserted_mm": 100.0}
    lag = steady_lag_deg(NITINOL, damping_n_mm_s_per_mm=0.017, rate_rad_s=rate, **lengths)
    assert lag == pytest.approx(lag_deg(NITINOL, base_torque_n_mm=1.7 * rate, **lengths))


@pytest.mark.parametrize("field", ["free_mm", "inserted_mm"])
def test_a_negative_length_is_refused_by_its_name(field):
    lengths = {"free_mm": 1.0, "inserted_mm": 1.0} | {field: -1.0}
    with pytest.raises(InvalidValue, match=field):
        lag_deg(NITINOL, base_torque_n_mm=1.0, **lengths)

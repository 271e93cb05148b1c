"""The printed figures agree with one another where the paper says how they are related."""

import math

import numpy as np
import pytest

from models import published


def test_the_printed_polar_moment_is_that_of_the_printed_diameter():
    moment = math.pi * published.NEEDLE_DIAMETER.value**4 / 32
    assert round(moment, 3) == published.POLAR_MOMENT.value


def test_the_printed_shear_modulus_is_that_of_the_printed_twist_test():
    twist = math.radians(published.TWIST_TEST_ANGLE.value)
    moment = math.pi * published.NEEDLE_DIAMETER.value**4 / 32
    torque, length = published.TWIST_TEST_TORQUE.value, published.TWIST_TEST_LENGTH.value
    assert round(1e-3 * torque * length / (twist * moment), 1) == published.NEEDLE_SHEAR_MODULUS.value


def test_poles_of_table_iii_go_as_the_squares_to_their_printed_digits():
    modal = np.array(published.TABLE_III_RAD_S["inertialess modal"][1:])
    assert modal / modal[0] == pytest.approx([1, 4, 9, 16], rel=5e-4)  # 0.0005 of -2.687, rounded


@pytest.mark.parametrize("table", ["TABLE_IV_SETTLE_S", "TABLE_V_INTEGRAL_DEG_S"])
def test_every_printed_compensator_is_better_than_the_base_alone(table):
    for base_only, feedforward, feedback in getattr(published, table).values():
        assert base_only > feedforward > feedback


def test_a_table_cannot_be_changed():
    with pytest.raises(TypeError):
        published.TABLE_IV_SETTLE_S[5.0] = (0.0, 0.0, 0.0)

"""Units as labs write them."""

import math

import pytest

from diagnosis.lab_files.units import QUANTITIES, Quantity, factor_of, is_unit, unit_in
from diagnosis.log.trial import COLUMNS

POUND_N, INCH_MM = 4.4482216152605, 25.4


@pytest.mark.parametrize(
    ("unit", "quantity", "factor"),
    [
        ("rad", Quantity.ANGLE, 180 / math.pi),
        ("°", Quantity.ANGLE, 1),
        ("rev", Quantity.ANGLE, 360),
        ("mrad", Quantity.ANGLE, 0.18 / math.pi),
        ("N m", Quantity.TORQUE, 1000),
        ("N·m", Quantity.TORQUE, 1000),
        ("mN m", Quantity.TORQUE, 1),
        ("mNm", Quantity.TORQUE, 1),
        ("N*mm", Quantity.TORQUE, 1),
        ("in-lb", Quantity.TORQUE, POUND_N * INCH_MM),
        ("lbf in", Quantity.TORQUE, POUND_N * INCH_MM),
        ("kip*in", Quantity.TORQUE, 1000 * POUND_N * INCH_MM),
        ("ft lb", Quantity.TORQUE, 12 * POUND_N * INCH_MM),
        ("oz-in", Quantity.TORQUE, POUND_N * INCH_MM / 16),
        ("kgf cm", Quantity.TORQUE, 98.0665),
        ("in", Quantity.LENGTH, INCH_MM),
        ("µm", Quantity.LENGTH, 1e-3),
        ("m/s", Quantity.SPEED, 1000),
        ("in/s", Quantity.SPEED, INCH_MM),
        ("ms", Quantity.TIME, 1e-3),
        ("ns", Quantity.TIME, 1e-9),
        ("rpm", Quantity.ANGULAR_RATE, 6),
        ("deg/s", Quantity.ANGULAR_RATE, 1),
        ("rev/min", Quantity.ANGULAR_RATE, 6),
    ],
)
def test_a_unit_has_the_factor_of_its_definition(unit, quantity, factor):
    assert factor_of(unit, quantity) == pytest.approx(factor, rel=1e-9)


@pytest.mark.parametrize(
    ("unit", "quantity"),
    [("in", Quantity.ANGLE), ("kip", Quantity.TORQUE), ("deg/s", Quantity.ANGLE), ("counts", Quantity.ANGLE),
     ("rev/s", Quantity.ANGLE), ("", Quantity.TIME)],
)  # fmt: skip
def test_a_unit_of_something_else_has_none(unit, quantity):
    assert factor_of(unit, quantity) is None


@pytest.mark.parametrize(
    ("name", "unit"),
    [
        ("disp (in)", "in"),
        ("torque [Nm]", "Nm"),
        ("base_angle_rad", "rad"),
        ("base_torque_n_mm", "n mm"),
        ("speed / rpm", "rpm"),
        ("Winkel [°]", "deg"),
        ("t", ""),
        ("torque", ""),
        ("motor angle", ""),
    ],
)
def test_a_unit_is_found_in_a_name(name, unit):
    assert unit_in(name) == unit


def test_every_column_has_a_quantity_and_its_own_unit_has_the_factor_1():
    assert set(QUANTITIES) == set(COLUMNS)
    for name, quantity in QUANTITIES.items():
        assert factor_of(unit_in(name), quantity) == 1, name


def test_units_without_a_scale_are_units_all_the_same():
    assert is_unit("kip")
    assert is_unit("counts")
    assert not is_unit("disp")

"""Units as labs write them."""

import math

import pytest

from diagnosis.lab_files.units import (
    QUANTITIES,
    MeasuredQuantity,
    factor_of,
    is_unit,
    unit_in,
    without_unit,
)
from diagnosis.log.trial import COLUMNS

POUND_N, INCH_MM = 4.4482216152605, 25.4


@pytest.mark.parametrize(
    ("unit", "quantity", "factor"),
    [
        ("rad", MeasuredQuantity.ANGLE, 180 / math.pi),
        ("°", MeasuredQuantity.ANGLE, 1),
        ("rev", MeasuredQuantity.ANGLE, 360),
        ("mrad", MeasuredQuantity.ANGLE, 0.18 / math.pi),
        ("N m", MeasuredQuantity.TORQUE, 1000),
        ("N·m", MeasuredQuantity.TORQUE, 1000),
        ("mN m", MeasuredQuantity.TORQUE, 1),
        ("mNm", MeasuredQuantity.TORQUE, 1),
        ("N*mm", MeasuredQuantity.TORQUE, 1),
        ("in-lb", MeasuredQuantity.TORQUE, POUND_N * INCH_MM),
        ("lbf in", MeasuredQuantity.TORQUE, POUND_N * INCH_MM),
        ("kip*in", MeasuredQuantity.TORQUE, 1000 * POUND_N * INCH_MM),
        ("ft lb", MeasuredQuantity.TORQUE, 12 * POUND_N * INCH_MM),
        ("oz-in", MeasuredQuantity.TORQUE, POUND_N * INCH_MM / 16),
        ("kgf cm", MeasuredQuantity.TORQUE, 98.0665),
        ("in", MeasuredQuantity.LENGTH, INCH_MM),
        ("µm", MeasuredQuantity.LENGTH, 1e-3),
        ("m/s", MeasuredQuantity.SPEED, 1000),
        ("in/s", MeasuredQuantity.SPEED, INCH_MM),
        ("ms", MeasuredQuantity.TIME, 1e-3),
        ("ns", MeasuredQuantity.TIME, 1e-9),
        ("rpm", MeasuredQuantity.ANGULAR_RATE, 6),
        ("deg/s", MeasuredQuantity.ANGULAR_RATE, 1),
        ("rev/min", MeasuredQuantity.ANGULAR_RATE, 6),
    ],
)
def test_a_unit_has_the_factor_of_its_definition(unit, quantity, factor):
    assert factor_of(unit, quantity) == pytest.approx(factor, rel=1e-9)


@pytest.mark.parametrize(
    ("unit", "quantity"),
    [
        ("in", MeasuredQuantity.ANGLE),
        ("kip", MeasuredQuantity.TORQUE),
        ("deg/s", MeasuredQuantity.ANGLE),
        ("rev/s", MeasuredQuantity.ANGLE),
        ("counts", MeasuredQuantity.ANGLE),
        ("", MeasuredQuantity.TIME),
    ],
)
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


@pytest.mark.parametrize(
    ("name", "rest"), [("Force [V]", "Force "), ("moment (Mz)", "moment (Mz)"), ("v", "v")]
)
def test_a_name_is_cut_before_its_unit_in_brackets(name, rest):
    assert without_unit(name) == rest


def test_every_column_has_a_quantity_and_its_own_unit_has_the_factor_1():
    assert set(QUANTITIES) == set(COLUMNS)
    for name, quantity in QUANTITIES.items():
        assert factor_of(unit_in(name), quantity) == 1, name


def test_units_without_a_scale_are_units_all_the_same():
    assert is_unit("kip")
    assert is_unit("counts")
    assert not is_unit("disp")

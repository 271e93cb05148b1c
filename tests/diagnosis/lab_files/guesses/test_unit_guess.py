"""Units by name, else by magnitude and as a question."""

import numpy as np
import pytest

from diagnosis.lab_files.guesses.unit_guess import guessed_unit
from diagnosis.lab_files.units import MeasuredQuantity

RAMP = np.linspace(0, 1, 101)


def test_a_unit_in_the_name_is_taken_without_a_question():
    guess = guessed_unit("angle [deg]", 3 * RAMP, MeasuredQuantity.ANGLE, ros_units=False)
    assert (guess.unit, guess.known, guess.asked) == ("deg", True, False)


def test_a_name_that_is_nothing_but_a_unit_is_the_unit():
    guess = guessed_unit("ms", RAMP, MeasuredQuantity.TIME, ros_units=False)
    assert (guess.unit, guess.known, guess.asked) == ("ms", True, False)


def test_a_unit_of_another_quantity_is_asked_for():
    guess = guessed_unit("disp (in)", RAMP, MeasuredQuantity.ANGLE, ros_units=False)
    assert (guess.unit, guess.known, guess.asked) == ("in", False, True)
    assert "how many deg" in guess.reason


@pytest.mark.parametrize(
    ("values", "quantity", "unit"),
    [
        (3.1 * RAMP, MeasuredQuantity.ANGLE, "rad"),
        (90 * RAMP, MeasuredQuantity.ANGLE, "deg"),
        (0.1 * RAMP, MeasuredQuantity.LENGTH, "m"),
        (100 * RAMP, MeasuredQuantity.LENGTH, "mm"),
        (0.01 * np.arange(9), MeasuredQuantity.TIME, "s"),
        (10.0 * np.arange(9), MeasuredQuantity.TIME, "ms"),
        (1e4 * np.arange(9), MeasuredQuantity.TIME, "us"),
        (1e7 * np.arange(9), MeasuredQuantity.TIME, "ns"),
        (RAMP, MeasuredQuantity.TORQUE, None),
    ],
)
def test_without_a_unit_the_magnitude_asks(values, quantity, unit):
    guess = guessed_unit("x", values, quantity, ros_units=False)
    assert guess.unit == unit
    assert guess.asked
    assert guess.reason.endswith("?")


def test_ros_has_units_of_its_own():
    guess = guessed_unit("effort", RAMP, MeasuredQuantity.TORQUE, ros_units=True)
    assert (guess.unit, guess.asked) == ("N m", False)


@pytest.mark.parametrize(
    ("name", "step", "told"),
    [
        ("Time [ms]", 0.001, "1e-06 s apart, 's' 0.001 s"),
        ("time (s)", 10.0, "10 s apart, 'ms' 0.01 s"),
        ("Time [ms]", 0.2, ""),
        ("time (s)", 1.0, ""),
        ("Time [ms]", 0.0, ""),
    ],
)
def test_a_unit_that_puts_the_rows_impossibly_far_apart_is_asked_for_and_not_used(name, step, told):
    guess = guessed_unit(name, step * np.arange(9), MeasuredQuantity.TIME, ros_units=False)
    assert (guess.unit is None) == guess.asked == bool(told)
    assert told in guess.reason

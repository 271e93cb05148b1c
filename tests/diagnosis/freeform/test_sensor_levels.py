"""Levels at which what a sensor reads changes."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import covered

from diagnosis.freeform.sensor_levels import (
    jump_parameter,
    largest_of,
    level_parameter,
    levels_found,
    read_over_levels,
)
from diagnosis.log.trial import TIP, TORQUE

ANGLE = turns(6.0)
PULLED = 0.01 * ANGLE


def ranges_with(error):
    """Ranges of a log whose torque is off by an error."""
    return covered(ANGLE, tip=ANGLE, torque=PULLED + error, seen=(ANGLE, PULLED))


def beyond(size, level):
    above = size > level
    return np.stack([above, np.where(above, size - level, 0.0)], axis=1)


def test_only_what_was_read_has_levels():
    both = ranges_with(0.0)
    assert [own.sensor for own in read_over_levels(both)] == [TORQUE, TIP]
    (only,) = read_over_levels(covered(ANGLE, tip=ANGLE + 1.0, seen=(ANGLE, PULLED)))
    assert only.sensor == TIP


def test_the_level_that_leaves_least_comes_first_with_its_coefficients():
    level, jump, slope = 0.4 * np.abs(PULLED).max(), 0.05, -0.3
    size = np.abs(PULLED)
    error = np.sign(PULLED) * (beyond(size, level) @ (jump, slope))
    ranges = ranges_with(error)
    own = read_over_levels(ranges)[0]
    found = levels_found(own, ranges, beyond)
    assert found[0][0] == pytest.approx(level, rel=0.08)  # those that are tried are 8 % apart
    assert found[0][1:] == pytest.approx((jump, slope), abs=0.05)
    left = [np.sum((error - np.sign(PULLED) * (beyond(size, at) @ both)) ** 2) for at, *both in found]
    assert left == sorted(left)


def test_of_columns_that_are_empty_there_is_no_level():
    ranges = ranges_with(0.0)
    own = read_over_levels(ranges)[0]
    assert levels_found(own, ranges, lambda size, _: np.zeros((size.size, 2))) == []


def test_parameters_have_the_bounds_of_the_largest_value():
    ranges = ranges_with(0.1)
    own = read_over_levels(ranges)[0]
    largest = largest_of(own, ranges)
    assert largest == pytest.approx(np.abs(PULLED).max(), rel=0.01)
    level, jump = (
        level_parameter(own, largest, (0.1, 0.2)),
        jump_parameter(own, ranges, largest, (0.0, 0.3)),
    )
    assert (level.start, level.high, level.unit) == ((0.1, 0.2), largest, "N mm")
    assert (jump.start, jump.low, jump.high) == ((0.0, 0.3), -largest, largest)
    assert jump.scale == ranges.missing[TORQUE]

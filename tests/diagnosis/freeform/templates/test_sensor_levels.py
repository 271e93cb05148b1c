"""Laws of a sensor on one side of a level: what they share."""

import numpy as np
import pytest
from level_logs import OF_TIP_ALONE, TORQUE, ranges_with

from diagnosis.freeform.templates.sensor_levels import LevelLaw, odd
from diagnosis.log import trial
from diagnosis.replay.rig_parameters import NOMINAL

LARGEST = np.abs(TORQUE).max()


def beyond(size, level):
    above = size > level
    return np.stack([above, np.where(above, size - level, 0.0)], axis=1)


def law(columns=beyond):
    """Its error tells its numbers."""
    return LevelLaw(
        where="somewhere",
        columns=columns,
        error=lambda largest, level, gain, jump: ((level, 2.0 * largest), (gain, jump)),
        gains=(-1.0, 1.4),
        start=(0.5, 0.2, -0.1),
    )


def test_only_what_was_read_has_a_family():
    both = law().families(ranges_with(0.0))
    assert [f.name for f in both] == [
        "torque reading over torque, somewhere",
        "tip reading over tip_angle, somewhere",
    ]
    (only,) = law().families(OF_TIP_ALONE)
    assert (only.says, only.x_unit, only.unit) == ("tip_angle", "deg", "deg")


def test_fits_start_from_the_level_that_leaves_least():
    level, jump, slope = 0.4 * LARGEST, 0.05, -0.3
    size = np.abs(TORQUE)
    error = np.sign(TORQUE) * (beyond(size, level) @ (jump, slope))
    own = law().families(ranges_with(error))[0]
    starts = list(zip(*(p.start for p in own.effect.parameters), strict=True))
    assert starts[0][0] == pytest.approx(level, rel=0.08)  # those that are tried are 8 % apart
    assert starts[0][1:] == pytest.approx((1.0 + slope, jump), abs=0.05)
    left = [
        np.sum((error - np.sign(TORQUE) * (beyond(size, at) @ (step, gain - 1.0))) ** 2)
        for at, gain, step in starts
    ]
    assert left == sorted(left)


def test_where_nothing_is_found_a_fit_starts_as_the_law_says():
    own = law(lambda size, _: np.zeros((size.size, 2))).families(ranges_with(0.1))[0]
    found = [p.start for p in own.effect.parameters]
    np.testing.assert_allclose(np.ravel(found), [0.5 * LARGEST, 0.2, -0.1 * LARGEST], rtol=0.01)


def test_no_number_starts_beyond_its_bounds():
    ranges = ranges_with(0.9 * TORQUE)  # a gain of 1.9, which is more than the law may have
    level, gain, jump = law().families(ranges)[0].effect.parameters
    assert max(gain.start) == gain.high == 1.4
    assert level.high == jump.high == -jump.low == pytest.approx(LARGEST, rel=0.01)
    for p in (level, gain, jump):
        assert all(p.low <= s <= p.high for s in p.start)
    assert jump.scale == ranges.missing[trial.TORQUE]


@pytest.mark.parametrize(("number", "acts_on"), [(0, "torque_reading"), (1, "tip_reading")])
def test_the_error_is_added_to_the_reading_of_its_sensor(number, acts_on):
    own = law().families(ranges_with(0.0))[number]
    (curve,) = own.effect.apply(NOMINAL, 0.3, 0.7, 0.1).free.curves
    assert curve.acts_on == acts_on
    assert (curve.places[0], curve.values) == (0.3, (0.7, 0.1))
    assert own.curve(0.3, 0.7, 0.1) == (curve.places, curve.values)


def test_odd_values_mirror_those_of_one_side():
    assert odd((1.0, 2.0)) == (-2.0, -1.0, 1.0, 2.0)

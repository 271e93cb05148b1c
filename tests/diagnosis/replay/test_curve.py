"""A curve of one variable."""

import numpy as np
import pytest

from diagnosis.replay.curve import FACTORS, ActsOn, Course, Curve
from diagnosis.replay.variables import Variable
from models.errors import InvalidValue

TIME = np.arange(0, 10, 0.01)
PLACES, VALUES = (0.0, 2.0, 3.0, 8.0), (1.0, 1.0, 4.0, 2.0)


def curve(acts_on=ActsOn.TIP_READING, variable=Variable.TIME, places=PLACES, values=VALUES, **more):
    return Curve(acts_on=acts_on, variable=variable, places=places, values=values, **more)


def test_a_curve_goes_through_its_points_and_is_level_beyond_them():
    own = curve()
    np.testing.assert_allclose(own.at(np.array(PLACES)), VALUES)
    np.testing.assert_allclose(own.at(np.array([-5.0, 50.0])), [1.0, 2.0])


def test_between_its_points_a_curve_does_not_overshoot():
    """Fritsch and Carlson: monotone between points, so that a factor stays positive."""
    own = curve().at(np.linspace(0, 8, 400))
    assert own.min() >= 1.0
    assert own.max() <= 4.0
    np.testing.assert_allclose(curve().at(np.linspace(0, 2, 50)), 1.0)


def test_two_points_are_a_straight_line():
    line = curve(places=(1.0, 3.0), values=(5.0, 9.0))
    np.testing.assert_allclose(line.at(np.array([1.5, 2.0, 2.75])), [6.0, 7.0, 8.5])


def test_a_sine_through_five_places_is_a_sine():
    """The error of a cubic spline is of fourth order in the places: (2 pi / 5)^4 / 384 = 0.6 %."""
    places = np.arange(5) * 36.0
    own = curve(places=tuple(places), values=tuple(np.sin(np.radians(2 * places + 20))), period=180.0)
    x = np.linspace(-300, 300, 400)
    np.testing.assert_allclose(own.at(x), np.sin(np.radians(2 * x + 20)), rtol=0, atol=0.01)


def test_a_periodic_curve_repeats_without_a_jump():
    own = curve(places=(0.0, 30.0, 60.0), values=(1.0, -2.0, 0.5), period=90.0)
    x = np.linspace(-400, 400, 333)
    np.testing.assert_allclose(own.at(x + 90.0), own.at(x), atol=1e-9)
    np.testing.assert_allclose(own.at(np.array([-90.0, 30.0, 150.0])), [1.0, -2.0, 0.5], atol=1e-9)
    assert own.at(np.array([90.0 - 1e-6]))[0] == pytest.approx(1.0, abs=1e-4)


def test_a_reading_of_the_past_alone_follows_a_step_as_a_filter_of_first_order():
    own = curve(variable=Variable.PAST, places=(0.5, 1.0), values=(1.0, 0.0))
    step = np.where(TIME > 2.0, 10.0, 0.0)
    since_s = np.maximum(TIME - 2.0, 0.0)
    expected = 10.0 * (1.0 - np.exp(-since_s / 0.5))
    # The step takes one sample: half of it is a delay.
    np.testing.assert_allclose(step + own.of_past(TIME, step), expected, atol=10.0 * 0.01 / 0.5)


def test_a_ramp_lags_by_the_shares_of_the_past_times_their_time_constants():
    own = curve(variable=Variable.PAST, places=(0.1, 0.3), values=(0.4, 0.5))
    lag = -own.of_past(TIME, 7.0 * TIME)[-1] / 7.0
    assert lag == pytest.approx(0.4 * 0.1 + 0.5 * 0.3, rel=0.01)


def test_what_creeps_follows_a_torque_with_each_of_its_time_constants():
    own = curve(ActsOn.DRIVE_ANGLE, Variable.PAST, (0.5, 2.0), (-3.0, -1.0))
    torque = np.where(TIME > 2.0, 0.4, 0.0)
    since_s = np.maximum(TIME - 2.0, 0.0)
    expected = 0.4 * (-3.0 * (1.0 - np.exp(-since_s / 0.5)) - (1.0 - np.exp(-since_s / 2.0)))
    np.testing.assert_allclose(own.creep(TIME, torque), expected, atol=0.4 * (3.0 / 0.5 + 0.5) * 0.01)


GROWS = Course(variable=Variable.TIME, places=(0.0, 5.0), values=(0.0, 2.0))


@pytest.mark.parametrize("acts_on", [*FACTORS, ActsOn.ORIENTATION])
def test_a_curve_that_multiplies_has_no_factor(acts_on):
    with pytest.raises(InvalidValue, match="because the curve multiplies"):
        curve(acts_on, factor=GROWS)


def test_a_factor_is_over_a_variable_of_the_inputs():
    with pytest.raises(InvalidValue, match="factor"):
        curve(factor=Course(variable=Variable.TORQUE, places=(0.0, 5.0), values=(0.0, 2.0)))


def test_a_strength_leaves_the_factor_as_it_is():
    twice = curve(factor=GROWS).times(2.0)
    assert twice.factor == GROWS
    assert twice.values == tuple(2.0 * value for value in VALUES)

"""A sensor that shows a new value only once that is far enough from what it shows."""

import numpy as np

from diagnosis.replay.sensing.held_reading import held_back

STEP = 0.125  # a power of 2: sums of it are exact
RAMP = STEP * np.arange(81)


def test_up_a_ramp_it_jumps_to_the_value_each_time_that_is_beyond_the_distance():
    """1 from what is shown is not beyond 1: it jumps every 1.125."""
    shown = RAMP + held_back(RAMP, 1.0)
    np.testing.assert_array_equal(shown, 1.125 * np.floor(RAMP / 1.125))


def test_a_value_that_stays_near_what_is_shown_is_never_shown():
    swings = 5.0 + np.sin(RAMP)
    np.testing.assert_array_equal(swings + held_back(swings, 1.01), 5.0)


def test_after_a_jump_it_is_held_about_where_that_went_to_either_way():
    values = np.array([0.0, 3.0, 1.5, 0.9, 0.0, -3.0])
    np.testing.assert_array_equal(values + held_back(values, 2.0), [0.0, 3.0, 3.0, 0.9, 0.9, -3.0])


def test_within_no_distance_it_shows_every_value_and_nothing_of_no_values():
    assert not held_back(np.sin(RAMP), 0.0).any()
    assert held_back(np.zeros(0), 1.0).size == 0

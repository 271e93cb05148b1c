"""A sensor that shows a new value only once that is far enough from what it shows."""

import numpy as np
import pytest

from diagnosis.replay.sensing.held_reading import held_back

STEP = 0.125  # a power of 2: sums of it are exact
RAMP = STEP * np.arange(81)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_up_a_ramp_it_jumps_each_time_that_the_value_is_at_the_distance(sign):
    shown = sign * (sign * RAMP + held_back(sign * RAMP, 1.0))
    np.testing.assert_array_equal(shown, np.floor(RAMP))


def test_rare_samples_show_the_same_as_close_ones():
    np.testing.assert_array_equal(held_back(RAMP, 1.0)[::5], held_back(RAMP[::5], 1.0))


def test_a_value_that_stays_near_what_is_shown_is_never_shown():
    swings = 5.0 + np.sin(RAMP)
    np.testing.assert_array_equal(swings + held_back(swings, 1.01), 5.0)


def test_after_a_jump_it_is_held_about_where_that_went_to_either_way():
    values = np.array([0.0, 3.0, 1.5, 0.9, 0.0, -3.0])
    np.testing.assert_array_equal(values + held_back(values, 2.0), [0.0, 2.0, 2.0, 2.0, 0.0, -2.0])


def test_within_hardly_any_distance_it_shows_every_value_and_nothing_of_no_values():
    assert np.abs(held_back(np.sin(RAMP), 1e-9)).max() <= 1e-9
    assert held_back(np.zeros(0), 1.0).size == 0

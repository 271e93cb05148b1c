"""Low-pass filters, against their closed forms and against an independent solver."""

import numpy as np
import pytest
from scipy.signal import butter, lsim

from diagnosis.replay.sensing.filters import butterworth, first_order, moving_average

TIME = np.linspace(0.0, 10.0, 1001)
FILTERS = (first_order, butterworth, moving_average)


def test_a_butterworth_filter_answers_as_that_of_an_independent_design():
    """scipy designs the filter and solves its state equations for values linear between samples."""
    values = np.interp(TIME, [0.0, 2.0, 2.3, 6.0, 10.0], [0.0, 0.0, 5.0, -1.0, 3.0])
    for tau in (0.004, 0.08):
        system = butter(2, 1.0 / tau, analog=True)
        _, expected, _ = lsim(system, values, TIME)
        np.testing.assert_allclose(butterworth(TIME, values, tau), expected, atol=1e-9)


@pytest.mark.parametrize("window_s", [0.004, 0.01, 0.237])
def test_a_moving_average_of_a_ramp_is_the_ramp_half_a_window_ago(window_s):
    shown = moving_average(TIME, TIME, window_s)
    inside = window_s < TIME
    np.testing.assert_allclose(shown[inside], TIME[inside] - 0.5 * window_s, atol=1e-9)
    np.testing.assert_allclose(shown[~inside], TIME[~inside] ** 2 / (2 * window_s), atol=1e-9)


def test_a_moving_average_over_whole_steps_is_that_of_trapezia():
    values = np.sin(3.0 * TIME)
    shown = moving_average(TIME, values, 0.05)
    weights = np.array([0.5, 1, 1, 1, 1, 0.5]) / 5
    np.testing.assert_allclose(shown[5:], np.convolve(values, weights, "valid"), atol=1e-9)


@pytest.mark.parametrize("filtered", FILTERS)
def test_a_filter_keeps_a_constant_and_is_none_where_its_time_is_0(filtered):
    np.testing.assert_allclose(filtered(TIME, np.full(1001, 2.5), 0.07), 2.5, rtol=1e-12)
    np.testing.assert_array_equal(filtered(TIME, np.cos(TIME), 0.0), np.cos(TIME))


@pytest.mark.parametrize(
    ("filtered", "delay"), [(first_order, 1.0), (butterworth, np.sqrt(2.0)), (moving_average, 0.5)]
)
def test_slow_values_are_shown_late_by_what_each_filter_says(filtered, delay):
    """The next term of the phase is of third order in rate * time: here 1e-5 of the delay."""
    rate, time_s = 0.1, 0.03
    late = TIME > 1.0
    shown = filtered(TIME, np.sin(rate * TIME), time_s)[late]
    expected = np.sin(rate * (TIME - delay * time_s))[late]
    np.testing.assert_allclose(shown, expected, atol=2e-5)

"""A sensor that follows at a limited rate, against closed forms."""

import numpy as np
import pytest

from diagnosis.replay.sensing.filters import first_order
from diagnosis.replay.sensing.limited_rate import lag_at_limited_rate

STEP_S = 0.001
TIME_S = np.arange(0.0, 6.0, STEP_S)


def test_without_a_limit_it_is_a_filter_of_first_order():
    """Backward Euler is off by half a step of the rate, 0.5 h / tau of the lag."""
    value, tau_s = 30.0 * np.sin(2.0 * TIME_S), 0.2
    shown = value - lag_at_limited_rate(TIME_S, value, tau_s, 1e9)
    exact = first_order(TIME_S, value, tau_s)
    largest_lag = np.abs(value - exact).max()
    assert np.abs(shown - exact).max() < STEP_S / tau_s * largest_lag


@pytest.mark.parametrize("sign", [1, -1])
def test_behind_a_step_it_runs_at_its_highest_rate_then_decays(sign):
    """From 50 at 20 / s, until the lag is tau 20 = 4; then exp(-t / tau)."""
    most, tau_s, step = 20.0, 0.2, 50.0
    value = np.where(TIME_S > 0.5, sign * step, 0.0)
    lag = sign * lag_at_limited_rate(TIME_S, value, tau_s, most)
    since_s = TIME_S - 0.5
    reached_s = (step - tau_s * most) / most
    runs = (since_s > 2 * STEP_S) & (since_s < reached_s)
    np.testing.assert_allclose(lag[runs], step - most * since_s[runs], atol=most * STEP_S)
    decays = since_s > reached_s
    exact = tau_s * most * np.exp(-(since_s[decays] - reached_s) / tau_s)
    np.testing.assert_allclose(lag[decays], exact, atol=2 * most * STEP_S)
    assert lag[-1] < 1e-6


def test_a_value_that_rests_has_no_lag():
    assert not lag_at_limited_rate(TIME_S, np.full(TIME_S.size, 7.0), 0.2, 1.0).any()

"""Scatter and steps of readings."""

import numpy as np
import pytest

from diagnosis.log.faults.scatter import quantum, runs_of, scatter, seen_scatter


def test_scatter_is_that_of_the_noise_and_quantum_that_of_the_display():
    rng = np.random.default_rng(6)
    values = np.linspace(0, 100, 5000) + rng.normal(0, 0.3, 5000)
    # 4500 second differences of correlated noise: a standard error of about 2 %.
    assert scatter(values) == pytest.approx(0.3, rel=0.06)
    stuck = values.copy()
    stuck[1000:2500] = stuck[1000]
    assert scatter(stuck) == pytest.approx(0.3, rel=0.06)
    assert quantum((values / 0.25).round() * 0.25) == pytest.approx(0.25)
    assert quantum(np.ones(10)) == 0


def test_runs_are_of_equal_values():
    starts, lengths = runs_of(np.array([1.0, 1.0, 2.0, 3.0, 3.0, 3.0]))
    np.testing.assert_array_equal(starts, [0, 2, 3])
    np.testing.assert_array_equal(lengths, [2, 1, 3])


def test_readings_that_scatter_far_less_than_claimed_or_than_a_step_show_none():
    values = np.random.default_rng(7).normal(0, 0.3, 2000)
    assert seen_scatter(values, 0.3) == pytest.approx(0.3, rel=0.1)
    assert seen_scatter(values, 3.0) == 0.0
    turning = np.linspace(0, 100, 2000) + values
    assert seen_scatter((turning / 2.0).round() * 2.0, 0.3) == 0.0

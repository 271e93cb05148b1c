"""Whether a residual is as small as noise, and as white."""

import numpy as np
import pytest

from diagnosis.fitting.noise_floor import floor_of


def test_white_residuals_are_at_the_floor_and_slow_ones_are_not():
    rng = np.random.default_rng(2)
    white = rng.normal(size=8000)
    assert floor_of([white]).reached
    slow = white + 0.25 * np.sin(np.linspace(0, 30, 8000))
    assert np.sqrt(np.mean(slow**2)) < 1.04  # nearly as small as noise, but not as white
    assert not floor_of([slow]).reached


def test_the_floor_allows_for_chance_where_samples_are_few():
    # Noise as its own first differences tell it: 1.03 alone would turn down one in fourteen.
    white = np.random.default_rng(3).normal(size=(400, 600))
    told = np.sqrt(0.5 * np.mean(np.diff(white, axis=1) ** 2, axis=1))
    floors = [floor_of([row / sigma]) for row, sigma in zip(white, told, strict=True)]
    assert np.std([floor.gap for floor in floors]) == pytest.approx(0.5 / np.sqrt(600), rel=0.15)
    assert sum(floor.gap > 1.03 for floor in floors) > 10
    assert sum(not floor.reached for floor in floors) <= 1
    assert floor_of([np.zeros(20_000)]).gap_limit == 1.03


def test_a_large_residual_is_neither_small_nor_at_the_floor():
    large = floor_of([1.1 * np.random.default_rng(4).normal(size=20_000)])
    assert not large.small
    assert not large.reached


def test_means_are_scaled_to_those_of_white_noise():
    blocks = floor_of([np.repeat([1.0, -1.0, 1.0], 25)])
    assert blocks.slow == pytest.approx(5.0)  # wholly slow: sqrt(25) of its root mean square of 1
    assert floor_of([np.tile([1.0, -1.0], 25)]).slow == pytest.approx(0.2)  # a sum of one in each 25


def test_trials_that_are_shorter_than_a_block_have_no_slow_part():
    assert floor_of([np.ones(10)]).slow == 1.0
    assert np.isnan(floor_of([]).gap)

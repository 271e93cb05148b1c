"""How much of a gap is explained."""

import numpy as np
import pytest

from diagnosis.assessment.gap_reduction import gap_reduction


def noise(sigma, seed):
    """Two trials of white noise."""
    rng = np.random.default_rng(seed)
    return tuple(sigma * rng.normal(size=size) for size in (3000, 2000))


def test_the_reduction_is_that_of_the_root_mean_squares():
    found = gap_reduction(noise(4.0, 1), noise(1.0, 2))
    # 5000 samples: 1 / sqrt(2 N) = 1 % of standard error.
    assert found.before == pytest.approx(4.0, rel=0.04)
    assert found.after == pytest.approx(1.0, rel=0.04)
    assert found.shrink == pytest.approx(1 - found.after / found.before)


def test_the_interval_is_that_of_chance():
    """The ratio of two root mean squares of N samples scatters by 1 / sqrt(N) of itself."""
    found = gap_reduction(noise(4.0, 1), noise(1.0, 2))
    half = 1.96 * 0.25 / np.sqrt(5000)
    # Quantiles of 400 resamples of 50 blocks: good to about 15 %.
    assert found.shrink - found.shrink_low == pytest.approx(half, rel=0.5)
    assert found.shrink_high - found.shrink == pytest.approx(half, rel=0.5)


def test_what_changes_nothing_reduces_nothing():
    same = noise(1.0, 1)
    found = gap_reduction(same, same)
    assert (found.shrink, found.shrink_low, found.shrink_high) == (0.0, 0.0, 0.0)


def test_trials_that_are_shorter_than_a_block_have_no_interval():
    short = (np.ones(50),)
    assert gap_reduction(short, short).shrink == 0.0

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


def test_what_predicts_unseen_trials_worse_than_the_nominal_rig_is_refuted():
    found = gap_reduction(noise(1.0, 1), noise(1.2, 2))
    assert "1.2 instead of 1 σ" in found.refutes.replace(f"{found.before:.3g}", "1")


@pytest.mark.parametrize(("before", "after"), [(1.0, 1.005), (4.0, 1.2), (1.001, 1.02)])
def test_what_is_at_the_noise_or_better_than_the_nominal_rig_is_not(before, after):
    assert not gap_reduction(noise(before, 1), noise(after, 2)).refutes


def test_trials_that_are_shorter_than_a_block_count():
    """A slow sensor leaves a trial of half a minute some dozens of readings."""
    found = gap_reduction((np.full(60, 4.0), np.full(90, 4.0)), (np.full(60, 1.0), np.full(90, 1.0)))
    assert (found.shrink, found.shrink_low, found.shrink_high) == pytest.approx((0.75, 0.75, 0.75))


def test_few_readings_have_an_interval_too():
    few = tuple(trial[:75] for trial in noise(4.0, 1)), tuple(trial[:75] for trial in noise(1.0, 2))
    found = gap_reduction(*few)
    half = 1.96 * 0.25 / np.sqrt(150)
    # Quantiles of 400 resamples of 21 blocks: good to about 20 %.
    assert found.shrink - found.shrink_low == pytest.approx(half, rel=0.5)
    assert found.shrink_high - found.shrink == pytest.approx(half, rel=0.5)


def test_every_reading_counts():
    """The last samples of a trial too, which do not fill a block."""
    before, after = np.ones(199), np.r_[np.ones(150), np.zeros(49)]
    found = gap_reduction((before,), (after,))
    assert found.shrink == pytest.approx(1 - found.after / found.before)

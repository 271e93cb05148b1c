"""Profiles of the base angle: from rest at zero, and no faster than asked for."""

import numpy as np
import pytest

from validation.logs.profiles import PROFILES, held, log_uniform, min_jerk, moves, steady

TIME = np.arange(0, 20.0, 0.0025)
ALL = {name: profile for name, (profile, _) in PROFILES.items()} | {"held": held}


@pytest.mark.parametrize("name", ALL)
def test_a_profile_starts_at_zero_and_moves(name):
    for seed in range(10):
        base = ALL[name](np.random.default_rng(seed), TIME, 120.0)
        assert base[0] == 0.0
        assert base.shape == TIME.shape
        assert np.ptp(base) > 1.0


@pytest.mark.parametrize("name", sorted({*ALL} - {"multisine", "sine", "chirp"}))
def test_a_turn_keeps_to_its_largest_rate(name):
    """A minimum-jerk turn is 15/8 of its mean rate at its peak."""
    for seed in range(20):
        base = ALL[name](np.random.default_rng(seed), TIME, 120.0)
        assert np.abs(np.diff(base)).max() / 0.0025 <= 120.0 * 15 / 8 * 1.001


@pytest.mark.parametrize("name", ALL)
def test_the_same_seed_gives_the_same_profile(name):
    one, other, third = (ALL[name](np.random.default_rng(s), TIME, 120.0) for s in (4, 4, 5))
    assert (one == other).all()
    assert (one != third).any()


def test_moves_follow_one_another_with_holds():
    base = moves(TIME, [(90.0, 1.0, 2.0), (-30.0, 1.0, 0.0)], steady)
    at = np.interp([0.5, 1.0, 2.9, 3.5, 4.0, 19.0], TIME, base)
    assert at == pytest.approx([45.0, 90.0, 90.0, 75.0, 60.0, 60.0])


def test_minimum_jerk_starts_and_ends_at_rest():
    h = 1e-4
    values = min_jerk(np.array([-1.0, 0.0, h, 0.5, 1.0 - h, 1.0, 2.0]))
    assert values[[0, 1, 3, 5, 6]] == pytest.approx([0.0, 0.0, 0.5, 1.0, 1.0])
    assert values[2] < 1e-11  # 10 h^3 = 1e-11 less 15 h^4
    assert 1.0 - values[4] < 1e-11


def test_a_log_uniform_draw_has_its_median_at_the_geometric_mean():
    """Of 2000 draws the share below the median has a standard deviation of 1.1 %."""
    rng = np.random.default_rng(0)
    draws = np.array([log_uniform(rng, 0.1, 10.0) for _ in range(2000)])
    assert 0.1 <= draws.min() < draws.max() <= 10.0
    assert np.mean(draws < 1.0) == pytest.approx(0.5, abs=0.045)

"""Stamps that jitter about even steps are told from samples that are uneven."""

import numpy as np
import pandas as pd
import pytest

from diagnosis.log.times.even_times import with_even_times
from diagnosis.log.trial import Trial

STEP_S, BASE = 0.01, 0.02
EVEN = STEP_S * np.arange(2000)


def turned(time_s):
    """A motion of up to 190 deg/s."""
    return 60 * np.sin(2 * np.pi * 0.5 * time_s)


def trial(stamps_s, taken_s, *, motion=turned, seed=1):
    """A trial that was read at other times than its stamps say."""
    noise = np.random.default_rng(seed).normal(0, BASE, taken_s.size)
    table = pd.DataFrame({"time_s": stamps_s, "base_angle_deg": motion(taken_s) + noise})
    return Trial(name="trial_01.csv", table=table)


def jittered(times_s, rms_s, seed=2):
    """The times, in order, off by so much."""
    return np.sort(times_s + np.random.default_rng(seed).normal(0, rms_s, times_s.size))


@pytest.mark.parametrize("rms_s", [0.0005, 0.003])
def test_stamps_that_jitter_are_set_on_even_steps_and_it_is_said(rms_s):
    stamps = jittered(EVEN, rms_s)
    (found,), (warning,) = with_even_times([trial(stamps, EVEN)])
    # A line through 2000 stamps: its ends are known to 2 rms / sqrt(2000).
    np.testing.assert_allclose(found["time_s"], EVEN, atol=0.2 * rms_s)
    assert "scatters by" in warning
    np.testing.assert_array_equal(found.file_rows.stamps_s, stamps)
    np.testing.assert_array_equal(found.file_rows.taken_s, found["time_s"])


def test_lost_rows_are_counted():
    kept = np.random.default_rng(3).random(EVEN.size) > 0.25
    stamps = jittered(EVEN[kept], 0.001)
    (found,), _ = with_even_times([trial(stamps, EVEN[kept])])
    np.testing.assert_allclose(found["time_s"], EVEN[kept], atol=0.0003)


def test_uneven_samples_that_are_stamped_rightly_are_left_alone():
    taken = jittered(EVEN, 0.003)
    one = trial(taken, taken)
    assert with_even_times([one]) == ([one], [])


def test_a_trial_at_rest_follows_the_others_of_its_log():
    still = trial(jittered(EVEN, 0.001, seed=5), EVEN, motion=np.zeros_like)
    assert with_even_times([still]) == ([still], [])
    found, _ = with_even_times([still, trial(jittered(EVEN, 0.001), EVEN)])
    np.testing.assert_allclose(found[0]["time_s"], EVEN, atol=0.0002)


def test_the_jitter_of_a_slow_trial_is_compared_with_its_own_steps():
    """At 40 Hz stamps scatter by more than the steps of a trial at 1 kHz, and count them."""
    slow = STEP_S * 2.5 * np.arange(800)
    fast = 0.001 * np.arange(20000)
    one = trial(jittered(slow, 0.004), slow)
    other = trial(jittered(fast, 0.0002), fast, seed=4)
    found, _ = with_even_times([one, other])
    np.testing.assert_allclose(found[0]["time_s"], slow, atol=0.0008)
    np.testing.assert_allclose(found[1]["time_s"], fast, atol=0.00004)


def test_a_trial_that_has_lost_count_keeps_its_stamps_beside_one_that_has_not():
    """Its clock runs by 3 % faster from the middle on: no even grid is within a step of that."""
    later = np.where(EVEN < 10, EVEN, 10 + 0.97 * (EVEN - 10))
    lost = trial(later, later)
    found, _ = with_even_times([lost, trial(jittered(EVEN, 0.001), EVEN)])
    np.testing.assert_array_equal(found[0]["time_s"], lost["time_s"])
    np.testing.assert_allclose(found[1]["time_s"], EVEN, atol=0.0002)


def test_even_stamps_are_left_alone():
    one = trial(EVEN, EVEN)
    assert with_even_times([one]) == ([one], [])


def test_stamps_that_have_lost_count_are_left_alone():
    """Jitter of most of a step, and every fifth row lost: no grid is certain."""
    kept = np.random.default_rng(3).random(EVEN.size) > 0.2
    stamps = jittered(EVEN[kept], 0.8 * STEP_S)
    found, _ = with_even_times([trial(stamps, EVEN[kept])])
    assert np.abs(found[0]["time_s"] - EVEN[kept]).max() < 6 * STEP_S

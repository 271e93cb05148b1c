"""Samples that were taken unevenly under even stamps are moved to where their base was there."""

import re
from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from diagnosis.criteria.log import JITTER_MOST_STEPS
from diagnosis.log.times.sampling_jitter import with_sampling_times
from diagnosis.log.trial import Trial

STEP_S, NOISE = 0.01, 0.01
STAMPS = STEP_S * np.arange(3000)

SCATTER = 0.03  # of a median of 1500 squares that tell: 1 / sqrt(2 x 0.37 x 1500), rounded to 0.1 ms


def said_ms(warning):
    return float(re.search(r"read ([\d.]+) ms", warning)[1])


def swinging(time_s):
    """A motion of up to 190 deg/s, slow at its ends."""
    return 60 * np.sin(2 * np.pi * 0.5 * time_s)


def staircase(time_s):
    """Turns at 100, 50 and 20 deg/s with sharp corners."""
    return np.interp(time_s, [0, 2, 4, 12, 30], [0, 0, 200, -200, 160])


def trial(late_s, motion=swinging, step_deg=0.0, seed=1):
    """Base and tip read late by these times, s, under even stamps."""
    rng = np.random.default_rng(seed)
    base = motion(STAMPS + late_s) + rng.normal(0, NOISE, STAMPS.size)
    if step_deg:
        base = step_deg * np.round(base / step_deg)
    tip = motion(STAMPS + late_s - 0.05)
    columns = {"time_s": STAMPS, "base_angle_deg": base, "tip_angle_deg": tip}
    return Trial(name="trial_01.csv", table=pd.DataFrame(columns))


def jitter(steps, seed=2):
    most = JITTER_MOST_STEPS * STEP_S
    return np.clip(np.random.default_rng(seed).normal(0, steps * STEP_S, STAMPS.size), -most, most)


@pytest.mark.parametrize("motion", [swinging, staircase])
@pytest.mark.parametrize("steps", [0.05, 0.2])
def test_samples_are_moved_to_when_they_were_taken(motion, steps):
    """What is left is the error of the curve, and the noise of a reading.

    A cubic through 11 readings has its middle to sqrt(9 / 4 / 11) = 0.45 of the scatter of one; noise
    of 0.01 deg is 0.4 of a jitter of 0.5 ms at 50 deg/s: together 0.6.
    """
    late = jitter(steps)
    (found,), (warning,) = with_sampling_times([trial(late, motion)])
    turning = np.abs(np.gradient(motion(STAMPS), STEP_S)) > 45
    left = (found["time_s"] - STAMPS - late)[turning]
    assert np.sqrt(np.mean(left**2)) < 0.7 * np.sqrt(np.mean(late[turning] ** 2))
    assert said_ms(warning) == pytest.approx(1e3 * steps * STEP_S, rel=4 * SCATTER)
    assert (np.diff(found["time_s"]) > 0).all()
    np.testing.assert_array_equal(found.file_rows.stamps_s, STAMPS)
    np.testing.assert_array_equal(found.file_rows.taken_s, found["time_s"])


@pytest.mark.parametrize("alike", ["time", "share of a step"])
def test_trials_of_other_rates_are_off_by_the_same_time_or_share_of_their_steps(alike):
    """At 20 Hz a share of 0.15 is 7.5 ms, and at 100 Hz 1.5 ms; or both are off by 2 ms."""
    steps_s, motion = (0.01, 0.05), swinging
    trials, lates = [], []
    for seed, step_s in enumerate(steps_s):
        stamps = step_s * np.arange(round(60 / step_s))
        rms_s = 0.002 if alike == "time" else 0.15 * step_s
        rng = np.random.default_rng(seed)
        lates.append(np.clip(rng.normal(0, rms_s, stamps.size), -0.45 * step_s, 0.45 * step_s))
        base = motion(stamps + lates[-1]) + rng.normal(0, NOISE, stamps.size)
        table = pd.DataFrame({"time_s": stamps, "base_angle_deg": base, "tip_angle_deg": base})
        trials.append(Trial(name=f"trial_{seed}.csv", table=table))
    found, (warning,) = with_sampling_times(trials)
    for before, after, late in zip(trials, found, lates, strict=True):
        turning = np.abs(np.gradient(motion(before["time_s"]), before["time_s"])) > 45
        left = (after["time_s"] - before["time_s"] - late)[turning]
        assert np.sqrt(np.mean(left**2)) < 0.7 * np.sqrt(np.mean(late[turning] ** 2))
    said = 2.0 if alike == "time" else 7.5
    assert said_ms(warning) == pytest.approx(said, rel=4 * SCATTER)


@pytest.mark.parametrize("lost", [0.05, 0.2])
def test_rows_may_be_missing(lost):
    """A fifth of the rows less is at most 1 / sqrt(0.8) = 1.12 times the error of the curve."""
    late, kept = jitter(0.2), np.random.default_rng(3).uniform(size=STAMPS.size) > lost
    whole = trial(late)
    (found,), (warning,) = with_sampling_times([replace(whole, table=whole.table[kept])])
    turning = np.abs(np.gradient(swinging(STAMPS), STEP_S))[kept] > 45
    left = (found["time_s"] - STAMPS[kept] - late[kept])[turning]
    assert np.sqrt(np.mean(left**2)) < 0.7 * 1.12 * np.sqrt(np.mean(late[kept][turning] ** 2))
    assert said_ms(warning) == pytest.approx(2.0, rel=4 * SCATTER)


def test_even_samples_with_missing_rows_are_left_alone():
    whole = trial(np.zeros(STAMPS.size))
    kept = np.random.default_rng(3).uniform(size=STAMPS.size) > 0.1
    one = replace(whole, table=whole.table[kept])
    assert with_sampling_times([one]) == ([one], [])


@pytest.mark.parametrize("motion", [swinging, staircase])
@pytest.mark.parametrize("step_deg", [0.0, 0.3], ids=["fine encoder", "coarse encoder"])
def test_even_samples_are_left_alone(motion, step_deg):
    one = trial(np.zeros(STAMPS.size), motion, step_deg)
    assert with_sampling_times([one]) == ([one], [])


def test_a_motion_that_no_curve_follows_is_no_jitter():
    """Turns at 9 Hz, eleven samples each: what a cubic leaves is alike from sample to sample."""
    one = trial(np.zeros(STAMPS.size), lambda t: swinging(t) + 5 * np.sin(2 * np.pi * 9.0 * t))
    assert with_sampling_times([one]) == ([one], [])


def test_a_trial_at_rest_stays_beside_one_that_tells():
    still = trial(jitter(0.2), np.zeros_like)
    found, _ = with_sampling_times([still, trial(jitter(0.2))])
    np.testing.assert_allclose(found[0]["time_s"], STAMPS, atol=1e-4)
    assert with_sampling_times([still]) == ([still], [])

"""Readings that are held over rows under noise are told by the motion, which comes in steps."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from diagnosis.log.times.held_readings import held_rows
from diagnosis.log.times.slow_sensors import with_new_readings
from diagnosis.log.trial import Trial

TIP, BASE = "tip_angle_deg", "base_angle_deg"
NOISE_DEG, CLAIMS = 0.4, {BASE: 0.02, TIP: 0.4}
TIME_S = np.arange(2400) / 200
MOTION = 60 * np.sin(2 * np.pi * 0.4 * TIME_S)


def held_over(rows, values, first=0):
    """The value of the row that was new last."""
    at = (np.arange(values.size) - first) // rows * rows + first
    return values[np.clip(at, 0, None)]


def log(tip, *, base=MOTION, noise=None, seed=1):
    rng = np.random.default_rng(seed)
    own = rng.normal(0, NOISE_DEG, TIME_S.size) if noise is None else noise
    read = {BASE: base + rng.normal(0, 0.02, TIME_S.size), TIP: tip + own}
    return Trial(name="trial_01.csv", table=pd.DataFrame({"time_s": TIME_S, **read}))


@pytest.mark.parametrize(("rows", "first"), [(2, 0), (2, 1), (3, 2), (5, 3)])
def test_rows_that_hold_the_last_reading_are_found_under_noise(rows, first):
    (old,) = held_rows([log(held_over(rows, MOTION, first))], TIP, NOISE_DEG)
    np.testing.assert_array_equal(~old, np.arange(old.size) % rows == first)


def correlated(size, kept=0.8):
    shaken, noise = np.random.default_rng(2).normal(0, NOISE_DEG, size), np.zeros(size)
    for i in range(1, size):
        noise[i] = kept * noise[i - 1] + shaken[i]
    return noise


@pytest.mark.parametrize(
    "read",
    [
        log(MOTION),
        log(np.roll(MOTION, 2)),
        log(MOTION, noise=correlated(MOTION.size)),
        log(np.interp(TIME_S, TIME_S[::2], MOTION[::2])),
        log(0 * MOTION),
        log(held_over(2, MOTION), base=held_over(2, MOTION)),
    ],
    ids=["new", "late", "correlated noise", "lines", "at rest", "a base in steps"],
)
def test_others_are_not(read):
    (old,) = held_rows([read], TIP, NOISE_DEG)
    assert not old.any()


def test_rows_that_are_missing_count():
    whole, kept = log(held_over(3, MOTION)), np.random.default_rng(5).random(TIME_S.size) > 0.05
    (old,) = held_rows([replace(whole, table=whole.table[kept].reset_index(drop=True))], TIP, NOISE_DEG)
    np.testing.assert_array_equal(old, np.flatnonzero(kept) % 3 != 0)


def test_a_trial_at_rest_is_read_as_the_others_are():
    moving, resting = log(held_over(3, MOTION)), log(0 * MOTION, base=0 * MOTION)
    assert all(
        old.mean() == pytest.approx(2 / 3) for old in held_rows([moving, resting], TIP, NOISE_DEG)
    )


def test_without_a_claimed_noise_nothing_is_known():
    (old,) = held_rows([log(held_over(2, MOTION))], TIP, 0.0)
    assert not old.any()


def test_they_do_not_count():
    read = log(held_over(2, MOTION))
    (found,), (said,) = with_new_readings([read], CLAIMS)
    new = np.isfinite(found[TIP])
    np.testing.assert_array_equal(new, np.arange(new.size) % 2 == 0)
    np.testing.assert_array_equal(found[BASE], read[BASE])
    assert "tip_angle_deg holds its last reading, under noise, between new ones every 10 ms" in said

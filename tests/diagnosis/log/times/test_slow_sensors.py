"""Rows that a logger fills between two readings of a slow sensor are no readings."""

import numpy as np
import pandas as pd
import pytest

from diagnosis.log.times.slow_sensors import with_new_readings
from diagnosis.log.trial import Trial

STEP_S, TIP, BASE = 0.01, 0.4, 0.02
NOISE = {"base_angle_deg": BASE, "tip_angle_deg": TIP}
TIME = STEP_S * np.arange(2000)
MOTION = 60 * np.sin(2 * np.pi * 0.5 * TIME)


def log(*, tip=None, base=None, digits=3, seed=1):
    """A trial whose sensors are read at every row, but for those that are given, (N,) each."""
    rng = np.random.default_rng(seed)
    read = {
        "base_angle_deg": MOTION + rng.normal(0, BASE, TIME.size),
        "tip_angle_deg": MOTION + rng.normal(0, TIP, TIME.size),
    }
    filled = {"base_angle_deg": base or _all, "tip_angle_deg": tip or _all}
    table = {name: np.round(filled[name](values), digits) for name, values in read.items()}
    return Trial(name="trial_01.csv", table=pd.DataFrame({"time_s": TIME, **table}))


def _all(values):
    return values


def new_rows(rows_apart):
    """Rows at which a sensor is read that is slower than the log."""
    return np.unique(np.floor(np.arange(0, TIME.size, rows_apart)).astype(int))


def held(rows_apart):
    def fill(values):
        last = np.searchsorted(new_rows(rows_apart), np.arange(values.size), "right") - 1
        return values[new_rows(rows_apart)[last]]

    return fill


def on_lines(rows_apart):
    """Lines between readings at times between the rows."""

    def fill(values):
        at = np.arange(0, values.size, rows_apart)
        return np.interp(np.arange(values.size), at, values[np.floor(at).astype(int)])

    return fill


@pytest.mark.parametrize("rows_apart", [1.5, 2, 3.3, 10])
def test_repeated_readings_count_once(rows_apart):
    read = log(tip=held(rows_apart))
    (found,), (said,) = with_new_readings([read], NOISE)
    new = np.flatnonzero(np.isfinite(found["tip_angle_deg"]))
    # By chance one new reading in 10^3 equals the last, to three digits: 0.001 / (2 sqrt(pi) 0.4).
    missed = np.setdiff1d(new_rows(rows_apart), new)
    assert np.isin(new, new_rows(rows_apart)).all()
    assert missed.size <= 5
    np.testing.assert_array_equal(found["tip_angle_deg"][new], read["tip_angle_deg"][new])
    np.testing.assert_array_equal(found["base_angle_deg"], read["base_angle_deg"])
    assert "tip_angle_deg repeats its last reading" in said
    assert "not used" in said


@pytest.mark.parametrize("rows_apart", [2, 3.3, 4, 10])
def test_of_lines_between_readings_the_rows_at_their_ends_count(rows_apart):
    (found,), (said,) = with_new_readings([log(tip=on_lines(rows_apart))], NOISE)
    new = np.flatnonzero(np.isfinite(found["tip_angle_deg"]))
    # Each is within a row of a reading, and nearly every reading has one.
    at = np.arange(0, TIME.size, rows_apart)
    assert np.abs(new[:, None] - at).min(axis=1).max() < 1
    assert new.size == pytest.approx(at.size, rel=0.02)
    assert "tip_angle_deg is interpolated between new ones" in said


def test_a_base_that_repeats_is_replaced_by_a_curve():
    read = log(base=held(3))
    (found,), (said,) = with_new_readings([read], NOISE)
    # A monotone cubic through points h apart is off by at most h^2 / 8 of the second derivative, and by
    # noise, which is within five sigma in 2000 readings.
    curvature = 60 * (2 * np.pi * 0.5) ** 2
    off = np.abs(found["base_angle_deg"] - MOTION)[:-3]
    assert off.max() < curvature * (3 * STEP_S) ** 2 / 8 + 5 * BASE
    assert np.abs(read["base_angle_deg"] - MOTION).max() > 10 * off.max()
    assert "base_angle_deg repeats" in said
    assert "smooth curve" in said


@pytest.mark.parametrize(
    "read",
    [
        log(),
        log(digits=1),  # one reading in five equals the last, by chance
        log(tip=lambda values: np.where((TIME > 5) & (TIME < 9), values[500], values)),  # frozen once
        log(tip=lambda values: values.clip(-45, 45)),  # saturated
        log(tip=lambda _: np.round(MOTION, 0)),  # a coarse encoder without noise
        log(tip=lambda _: MOTION.clip(-30, 30)),  # a simulation that rests
        log(base=lambda _: np.round(MOTION / 0.09) * 0.09),
    ],
    ids=["all new", "few digits", "frozen once", "saturated", "coarse", "exact", "coarse base"],
)
def test_readings_at_every_row_stay_as_they_are(read):
    (found,), said = with_new_readings([read], NOISE)
    assert said == []
    assert found is read


def test_trials_that_a_logger_filled_are_named():
    found, (said,) = with_new_readings([log(), log(tip=held(4)), log(seed=2)], NOISE)
    assert [int(np.isfinite(own["tip_angle_deg"]).sum()) for own in found] == [2000, 500, 2000]
    assert "1500 of 2000 rows" in said

"""Roughness of time: stamps in order, clocks that run off, rows that are lost, rates."""

import numpy as np
import pytest

from validation.logs.motions import draw_motions, draw_plan
from validation.logs.roughness.timing import (
    RATES_HZ,
    dropped_samples,
    jittered,
    sampling_rate,
    sensor_clock,
    time_jitter,
)
from validation.logs.sensors import TIP, TORQUE

RAMP = {"tip_deg": lambda time_s: 1e4 * time_s, "torque_n_mm": lambda time_s: 1e4 * time_s}
"""Steep enough for noise to be nothing: 0.4 deg are 0.04 ms."""


def test_jitter_has_its_size_and_keeps_the_order():
    """Of 10 000 times the rms is known to 0.7 %; that a few are held back takes off less than 2 %."""
    times = np.arange(10_000) * 0.01
    off = jittered(np.random.default_rng(0), times, 1.5e-3) - times
    assert off.std() == pytest.approx(1.5e-3, rel=0.05)
    assert np.abs(np.diff(off)).max() < 0.009


def test_jitter_of_fast_logs_is_a_quarter_of_their_interval():
    times = np.arange(10_000) * 0.001
    stamps = jittered(np.random.default_rng(0), times, 3e-3)
    assert (stamps - times).std() == pytest.approx(0.25e-3, rel=0.1)
    assert np.diff(stamps).min() >= 0.0001 * (1 - 1e-6)


@pytest.mark.parametrize("right", [True, False])
def test_stamps_or_samples_jitter(drawn, recorded, right):
    """Right stamps are those of the reading; wrong ones are off by their rms."""
    one = drawn(time_jitter, stamped_correctly=right)
    (columns,) = recorded(one, **RAMP)
    time_s, rms_s = columns["time_s"], one.numbers["rms_s"]
    assert 0.5e-3 <= rms_s <= 3e-3
    assert (np.diff(time_s) > 0).all()
    assert (time_s - np.arange(time_s.size) * 0.01).std() == pytest.approx(min(rms_s, 2.5e-3), rel=0.1)
    error_s = (columns[TIP] / 1e4 - time_s).std()
    assert error_s == pytest.approx(4e-5 if right else min(rms_s, 2.5e-3), rel=0.1)


@pytest.mark.parametrize("seed", range(6))
def test_a_clock_runs_off_in_proportion_to_time(recorded, seed):
    one = sensor_clock(np.random.default_rng(seed))
    (columns,) = recorded(one, **RAMP)
    (wrong,), error = one.numbers["signals"], one.numbers["error"]
    right = TORQUE if wrong == TIP else TIP
    time_s = columns["time_s"]
    assert 2e-4 <= abs(error) <= 0.01
    assert columns[wrong] / 1e4 == pytest.approx(time_s * (1 + error), abs=3e-4)
    assert columns[right] / 1e4 == pytest.approx(time_s, abs=3e-4)
    assert time_s[-1] == pytest.approx(100 / (1 + max(error, 0.0)), abs=0.011)


@pytest.mark.parametrize("seed", range(8))
def test_rows_are_lost_singly_and_in_gaps(recorded, seed):
    """Shares of 5 to 30 % of 10 001 rows are kept to 4 standard deviations; gaps last 0.1 to 1 s."""
    one = dropped_samples(np.random.default_rng(seed))
    (columns,) = recorded(one)
    time_s, share = columns["time_s"], one.numbers["share"]
    assert time_s[0] == 0.0
    longest, lost = np.diff(time_s).max(), 1 - time_s.size / 10_001
    assert share == 0 or 0.05 <= share <= 0.3
    if one.numbers["most_gaps"]:
        assert 0.09 <= longest < 1.3
        assert -0.02 < lost - share < 0.01 * one.numbers["most_gaps"] + 0.02
    else:
        assert longest < 0.12
        assert lost == pytest.approx(share, abs=4 * 0.0046)
    assert all(values.size == time_s.size for values in columns.values())


def test_rates_are_those_of_labs_and_fast_logs_are_short():
    """Durations are at least 10 s each, so a log of four trials stays near a minute."""
    seen = set()
    for seed in range(30):
        rng = np.random.default_rng(seed)
        one = sampling_rate(rng)
        rate = one.numbers["rate_hz"]
        seen.add(rate)
        plan = one.plan(draw_plan(rng, short=False, slides=False, loads=False))
        assert plan.rate_hz == rate
        if rate >= 500 and seed < 20:
            motions = draw_motions(rng, plan)
            assert sum(motion.time_s[-1] for motion in motions) < 70
            assert motions[0].dt_s * motions[0].per_sample == pytest.approx(1 / rate)
    assert seen == {*RATES_HZ} == {20, 25, 33, 250, 500, 1000}

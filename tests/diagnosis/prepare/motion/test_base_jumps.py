"""Jumps of the base's reading."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of

from diagnosis.criteria.faults import LOST_COUNTS_MOST_SMALL
from diagnosis.log.trial import BASE
from diagnosis.prepare.motion.base_jumps import large_jumps, small_jumps
from diagnosis.replay.rig_parameters import NOMINAL

AT, NOISE_DEG = 650, 0.02


def read_with(log, size_deg, number=0):
    """The log, whose encoder scatters, and jumps in one trial."""
    rng = np.random.default_rng(3)
    jumps_deg = [
        size_deg * (np.arange(t[BASE].size) >= AT) * (n == number) for n, t in enumerate(log.trials)
    ]
    trials = [
        replace(
            t,
            table=t.table.assign(
                **{BASE: t[BASE] + jump_deg + rng.normal(0.0, NOISE_DEG, t[BASE].size)}
            ),
        )
        for t, jump_deg in zip(log.trials, jumps_deg, strict=True)
    ]
    return replace(log, trials=tuple(trials))


@pytest.fixture(scope="module")
def exact():
    return joined(*(log_of(NOMINAL, seed=i) for i in range(2)))


def test_a_jump_scatters_by_the_noise_of_two_readings(exact):
    (jump,) = large_jumps(read_with(exact, 4.0, number=1))
    assert (jump.number, jump.sample) == (1, AT)
    assert jump.size_deg == pytest.approx(4.0, abs=4.0 * np.sqrt(2.0) * NOISE_DEG)
    assert NOISE_DEG <= jump.scatter_deg < 2.0 * np.sqrt(2.0) * NOISE_DEG


def test_large_jumps_are_few(exact):
    assert large_jumps(read_with(exact, 0.2)) == []


def test_a_small_jump_sticks_out_of_the_scatter_beside_it(exact):
    jumps = small_jumps(read_with(exact, 0.3, number=1))
    assert [j.number for j in jumps] == sorted(j.number for j in jumps)
    assert all(sum(j.number == n for j in jumps) <= LOST_COUNTS_MOST_SMALL for n in (0, 1))
    (lost,) = [j for j in jumps if (j.number, j.sample) == (1, AT)]
    assert lost.size_deg == pytest.approx(0.3, abs=0.1)
    assert lost.at_s == exact.trials[1]["time_s"][AT]
    assert lost.times(2.0).size_deg == 2.0 * lost.size_deg


def test_a_shaft_that_turns_evenly_does_not_jump_however_uneven_the_rows_are(exact):
    trial = exact.trials[0]
    steps_s = np.where(np.arange(trial["time_s"].size) % 3, 0.01, 0.02)
    times_s = np.cumsum(steps_s)
    turning = trial.table.assign(time_s=times_s, base_angle_deg=40.0 * times_s)
    log = replace(exact, trials=(replace(trial, table=turning),))
    assert [j for j in small_jumps(log) if abs(j.size_deg) > 1e-9] == []

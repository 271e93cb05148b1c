"""An encoder of the base that loses counts."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of

from diagnosis.criteria import LOST_COUNTS_MOST_SMALL
from diagnosis.lost_counts import small_jumps, with_counts_restored, with_jumps_restored
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL

BASE, AT = "base_angle_deg", 650


def losing(log, size_deg, at=AT, number=0):
    """The log, whose encoder loses counts in one trial."""
    trial = log.trials[number]
    base = trial[BASE].copy()
    base[at:] += size_deg
    trials = list(log.trials)
    trials[number] = replace(trial, table=trial.table.assign(**{BASE: base}))
    return replace(log, trials=tuple(trials))


@pytest.fixture(scope="module")
def exact():
    return joined(*(log_of(NOMINAL, seed=i) for i in range(2)))


@pytest.mark.parametrize(("size_deg", "number"), [(4.0, 0), (-2.5, 1)])
def test_readings_after_a_loss_are_shifted_back(exact, size_deg, number):
    found = replay_nominal(losing(exact, size_deg, number=number))
    (warning,) = [w for w in found.log.warnings if "lost counts" in w]
    assert exact.trials[number].name in warning
    restored = found.log.trials[number][BASE] - exact.trials[number][BASE]
    np.testing.assert_allclose(restored[:AT], 0.0)
    np.testing.assert_allclose(restored[AT:], 0.0, atol=0.3)  # moves beside it differ by noise
    assert found.fit.gap == pytest.approx(1.0, abs=0.1)


def test_a_log_that_has_lost_none_stays_as_it_is(exact):
    found = replay_nominal(exact)
    assert not any("lost counts" in warning for warning in found.log.warnings)


def test_a_jump_that_the_other_sensors_follow_is_a_turn(exact):
    """Shifted back, the nominal rig would leave more."""
    jumping = losing(exact, 4.0)
    squares = iter([4.0, 16.0])
    assert with_counts_restored(jumping, lambda _: next(squares)) is jumping


def test_what_takes_off_little_decides_nothing(exact):
    jumping = losing(exact, 4.0)
    squares = iter([100.0, 96.0])
    assert with_counts_restored(jumping, lambda _: next(squares)) is jumping
    squares = iter([100.0, 25.0])
    assert len(with_counts_restored(jumping, lambda _: next(squares)).warnings) == 1


def test_a_smooth_log_asks_for_no_simulation(exact):
    assert with_counts_restored(exact, pytest.fail) is exact


def test_across_a_gap_in_the_time_nothing_is_told(exact):
    """A shaft that turns evenly moves by more across rows that are missing."""
    trial = exact.trials[0]
    turning = trial.table.assign(base_angle_deg=40.0 * trial["time_s"])
    gap = turning.drop(index=range(AT, AT + 8)).reset_index(drop=True)
    log = replace(exact, trials=(replace(trial, table=gap),))
    assert with_counts_restored(log, pytest.fail) is log


def read_with_noise(log, sigma_deg=0.02):
    """The log, whose encoder scatters."""
    rng = np.random.default_rng(3)
    trials = [
        replace(t, table=t.table.assign(**{BASE: t[BASE] + rng.normal(0.0, sigma_deg, t[BASE].size)}))
        for t in log.trials
    ]
    return replace(log, trials=tuple(trials))


def test_a_small_jump_sticks_out_of_the_scatter_beside_it(exact):
    jumps = small_jumps(losing(read_with_noise(exact), 0.3, number=1))
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


def test_jumps_that_are_known_are_shifted_back_with_a_warning_each(exact):
    lost = losing(losing(read_with_noise(exact), 0.3), -0.2, at=900)
    known = [j for j in small_jumps(lost) if (j.number, j.sample) in ((0, AT), (0, 900))]
    restored = with_jumps_restored(lost, known)
    assert len(restored.warnings) == len(known) == 2
    off_deg = restored.trials[0][BASE] - exact.trials[0][BASE]
    np.testing.assert_allclose(off_deg[900:].mean(), 0.0, atol=0.15)  # sizes as read, amid noise

"""An encoder of the base that loses counts."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of

from diagnosis.lost_counts import with_counts_restored, with_jumps_restored
from diagnosis.nominal_replay import replay_nominal
from diagnosis.prepare.motion.base_jumps import small_jumps
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


def read_with_noise(log, sigma_deg=0.02, seed=3):
    """The log, whose encoder scatters."""
    rng = np.random.default_rng(seed)
    trials = [
        replace(t, table=t.table.assign(**{BASE: t[BASE] + rng.normal(0.0, sigma_deg, t[BASE].size)}))
        for t in log.trials
    ]
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
    left = iter([np.array([2.0]), np.array([4.0])])
    assert with_counts_restored(jumping, lambda _: next(left)) is jumping


def test_what_takes_off_little_decides_nothing(exact):
    jumping = losing(exact, 4.0)
    left = iter([np.array([10.0]), np.array([9.8])])
    assert with_counts_restored(jumping, lambda _: next(left)) is jumping
    left = iter([np.array([10.0]), *[np.array([5.0])] * 4])
    assert len(with_counts_restored(jumping, lambda _: next(left)).warnings) == 1


@pytest.mark.parametrize(("count", "beyond"), [(200, 0.0), (200, 98.0), (2, 0.0)])
def test_the_size_follows_from_the_reading_and_from_the_other_sensors(exact, count, beyond):
    """Here these are least at a size one scatter below the reading's: a parabola n^2 + w (n + 1)^2."""
    lost = losing(read_with_noise(exact), 4.0)
    jump = small_jumps(lost)[0]
    assert (jump.number, jump.sample) == (0, AT)

    def left(one):
        shifted_deg = lost.trials[0][BASE][-1] - one.trials[0][BASE][-1]
        from_least = (shifted_deg - jump.size_deg) / jump.scatter_deg + 1.0
        return np.full(count, np.sqrt(1.0 + beyond + from_least**2) if shifted_deg else 100.0)

    restored = with_counts_restored(lost, left)
    weight = count / (2.0 + beyond)
    shifted_deg = lost.trials[0][BASE][-1] - restored.trials[0][BASE][-1]
    least = -weight / (weight + 1.0)
    assert (shifted_deg - jump.size_deg) / jump.scatter_deg == pytest.approx(least, rel=1e-6)


def test_the_nominal_rig_tells_the_size_nearer_than_the_reading(exact):
    """A jump between two readings of 0.1 deg scatters by 0.14 deg; 1000 of the tip tell far more."""
    off_deg = np.zeros((2, 4))
    for seed in range(4):
        lost = losing(read_with_noise(exact, 0.1, seed), 4.0)
        restored = replay_nominal(lost).log.trials[0][BASE]
        off_deg[0, seed] = small_jumps(lost)[0].size_deg - 4.0
        off_deg[1, seed] = np.mean(restored[AT:] - exact.trials[0][BASE][AT:])
    read, told = np.sqrt(np.mean(off_deg**2, axis=1))
    assert told < 0.5 * read


def test_a_smooth_log_asks_for_no_simulation(exact):
    assert with_counts_restored(exact, pytest.fail) is exact


def test_across_a_gap_in_the_time_nothing_is_told(exact):
    """A shaft that turns evenly moves by more across rows that are missing."""
    trial = exact.trials[0]
    turning = trial.table.assign(base_angle_deg=40.0 * trial["time_s"])
    gap = turning.drop(index=range(AT, AT + 8)).reset_index(drop=True)
    log = replace(exact, trials=(replace(trial, table=gap),))
    assert with_counts_restored(log, pytest.fail) is log


def test_jumps_that_are_known_are_shifted_back_with_a_warning_each(exact):
    lost = losing(losing(read_with_noise(exact), 0.3), -0.2, at=900)
    known = [j for j in small_jumps(lost) if (j.number, j.sample) in ((0, AT), (0, 900))]
    restored = with_jumps_restored(lost, known)
    assert len(restored.warnings) == len(known) == 2
    off_deg = restored.trials[0][BASE] - exact.trials[0][BASE]
    np.testing.assert_allclose(off_deg[900:].mean(), 0.0, atol=0.15)  # sizes as read, amid noise

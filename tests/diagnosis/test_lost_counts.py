"""An encoder of the base that loses counts."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of

from diagnosis.lost_counts import with_counts_restored
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
    gaps = iter([2.0, 4.0])
    assert with_counts_restored(jumping, lambda _: next(gaps)) is jumping


def test_what_takes_off_little_decides_nothing(exact):
    jumping = losing(exact, 4.0)
    gaps = iter([10.0, 9.8])
    assert with_counts_restored(jumping, lambda _: next(gaps)) is jumping
    gaps = iter([10.0, 5.0])
    assert len(with_counts_restored(jumping, lambda _: next(gaps)).warnings) == 1


def test_a_smooth_log_asks_for_no_simulation(exact):
    assert with_counts_restored(exact, pytest.fail) is exact


def test_across_a_gap_in_the_time_nothing_is_told(exact):
    """A shaft that turns evenly moves by more across rows that are missing."""
    trial = exact.trials[0]
    turning = trial.table.assign(base_angle_deg=40.0 * trial["time_s"])
    gap = turning.drop(index=range(AT, AT + 8)).reset_index(drop=True)
    log = replace(exact, trials=(replace(trial, table=gap),))
    assert with_counts_restored(log, pytest.fail) is log

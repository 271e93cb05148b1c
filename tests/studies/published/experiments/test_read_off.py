"""What is read off a run."""

from types import SimpleNamespace

import numpy as np
import pytest

from diagnosis.replay.rig_parameters import RigParameters
from studies.published.experiments.measurement import Quantity, TurnExperiment
from studies.published.experiments.read_off import interpolated_settling_s, read_off
from studies.published.experiments.rig import PublishedRig


def run_of(time_s, tip_deg, torque, drive):
    return SimpleNamespace(
        time_s=time_s,
        tip_deg=tip_deg,
        base_torque_n_mm=torque,
        inputs=SimpleNamespace(time_s=time_s, drive=drive),
    )


def test_settling_is_between_samples_and_later_the_farther_it_is_from_settled():
    time = np.array([0.0, 1.0, 2.0])
    assert interpolated_settling_s(time, np.array([9.0, 5.0, 1.0])) == pytest.approx(1.5)
    assert interpolated_settling_s(time, np.array([2.0, 1.0, 0.0])) == 0.0
    late, later = (interpolated_settling_s(time, np.array([9.0, 8.0, end])) for end in (4.0, 5.0))
    assert 2.0 < late < later
    # It counts that the error leaves the band again, on either side.
    assert interpolated_settling_s(time, np.array([9.0, 0.0, -4.0])) > 2.0


def test_a_quick_turn_is_judged_by_what_its_sensor_shows():
    time = np.linspace(0.0, 2.5, 251)
    run = run_of(time, np.full(251, 90.0), np.zeros(251), np.full(251, 90.0))
    exact, biased = (
        read_off(TurnExperiment.QUICK_TURN, run, PublishedRig(model=RigParameters(tip_bias_deg=bias)))
        for bias in (0.0, -2.0)
    )
    assert exact[Quantity.INTEGRAL] == 0.0
    # 2 deg over 2 s; within the band of 3 deg.
    assert biased[Quantity.INTEGRAL] == pytest.approx(4.0)
    assert biased[Quantity.SETTLING] == 0.0
    assert (exact[Quantity.ERROR_LEFT], biased[Quantity.ERROR_LEFT]) == (0.0, 2.0)


def test_a_held_turn_shows_damping_lag_and_the_torque_that_is_held():
    time = np.arange(0.0, 30.05, 0.1)
    turning = time <= 20.0
    torque, drive = np.where(turning, 0.2, 0.05), np.minimum(4.5 * time, 90.0)
    values = read_off(TurnExperiment.HELD_TURN, run_of(time, drive - 6.0, torque, drive), PublishedRig())
    assert values[Quantity.DAMPING] == pytest.approx(0.2 / np.radians(4.5))
    assert values[Quantity.LAG] == pytest.approx(6.0)
    # One of the 101 samples is the last of the turn.
    assert values[Quantity.HELD_TORQUE] == pytest.approx(0.05, rel=0.05)


def test_a_release_shows_which_share_of_the_lag_is_left():
    time = np.arange(0.0, 35.05, 0.1)
    lag = np.where(time <= 30.0, 8.0, 2.0)
    drive = np.minimum(4.5 * time, 90.0)
    run = run_of(time, drive - lag, np.zeros(time.size), drive)
    assert read_off(TurnExperiment.RELEASE, run, PublishedRig())[Quantity.LAG_LEFT] == pytest.approx(
        0.25
    )

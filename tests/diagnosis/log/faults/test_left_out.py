"""Readings that are left out of a log, with a warning that says which."""

import numpy as np
from diagnosis_fixtures import log_of

from diagnosis.log.faults.left_out import LeftOut, without
from diagnosis.replay.rig_parameters import NOMINAL

TIP, TORQUE = "tip_angle_deg", "base_torque_n_mm"


def test_readings_are_left_out_of_their_sensor_and_trial_alone():
    log = log_of(NOMINAL, seconds=3.0)
    (trial,) = log.trials
    left = LeftOut(trial=trial.name, sensor=TIP, times_s=trial["time_s"][[10, 20]], samples=300)
    elsewhere = LeftOut(trial="trial_02.csv", sensor=TORQUE, times_s=np.array([0.1]), samples=300)
    (found,) = without(log, [left, elsewhere]).trials
    assert list(np.flatnonzero(np.isnan(found[TIP]))) == [10, 20]
    np.testing.assert_array_equal(found[TORQUE], trial[TORQUE])
    assert not np.isnan(trial[TIP]).any()  # the log that was read is not changed


def test_the_warning_names_the_samples_up_to_five():
    log = log_of(NOMINAL, seconds=3.0)
    left = LeftOut(trial="trial_01.csv", sensor=TIP, times_s=np.arange(1, 8) / 10, samples=300)
    *_, said = without(log, [left]).warnings
    assert said.startswith("trial_01.csv: tip_angle_deg is far off the explanation in 7 of 300 samples")
    assert "at 0.1, 0.2, 0.3, 0.4, 0.5 and 2 more s" in said


def test_with_nothing_left_out_the_log_is_the_same():
    log = log_of(NOMINAL, seconds=3.0)
    same = without(log, [])
    assert (same.warnings, same.trials) == (log.warnings, log.trials)

"""A log beside what its nominal rig predicts."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import joined, log_of
from scipy.ndimage import uniform_filter1d

from diagnosis.nominal_replay import nominal_residuals, replay_nominal
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters


@pytest.fixture(scope="module")
def nominal():
    return replay_nominal(log_of(RigParameters(kinetic_n_mm_per_mm=0.001), seconds=6.0))


def test_residuals_of_the_nominal_rig_are_those_of_its_fit(nominal):
    by_trial = nominal_residuals(nominal.problem, nominal.predictions)
    again = nominal.problem.residuals([NOMINAL])
    assert len(by_trial) == len(again) == len(nominal.log.trials)
    for one, other, fitted in zip(by_trial, again, nominal.fit.by_trial, strict=True):
        np.testing.assert_array_equal(one, other[0])
        np.testing.assert_array_equal(one, fitted)


def test_a_log_that_begins_at_rest_is_replayed_by_the_nominal_rig_itself(nominal):
    assert nominal.rig == NOMINAL
    assert nominal.problem.log.trials[0].late_start is None


@pytest.mark.parametrize("off_deg", [0.0, 3.0])
def test_smoothed_readings_tell_a_start_before_they_are_in_their_low_band(off_deg):
    """Rows of the low band are too rare for it: of one trial the needle rests elsewhere in the play."""
    seconds, rows = 6.0, 9
    log = joined(*(log_of(NOMINAL, seconds=seconds, seed=seed) for seed in range(3)))
    trials = [
        replace(one, table=one.table.assign(tip_angle_deg=uniform_filter1d(one["tip_angle_deg"], rows)))
        for one in log.trials
    ]
    last = trials[-1].table
    trials[-1] = replace(trials[-1], table=last.assign(tip_angle_deg=last["tip_angle_deg"] + off_deg))
    corner_hz = 0.443 / (rows * 0.01)
    smoothed = replace(log, trials=tuple(trials), smoothed_above_hz={"tip_angle_deg": corner_hz})
    begun = replay_nominal(smoothed).problem.log.trials
    assert [one.late_start is not None for one in begun] == [False, False, off_deg != 0.0]


def test_the_noise_is_that_of_the_log_whatever_the_nominal_rig_lacks(nominal):
    """Fourth differences tell it to 1 / sqrt(2 N 0.3), 5 % of 600 samples; three of these."""
    right = replay_nominal(log_of(NOMINAL, seconds=6.0))
    for sensor in ("tip_angle_deg", "base_torque_n_mm"):
        assert nominal.problem.noise[sensor] == pytest.approx(right.problem.noise[sensor], rel=0.15)


def test_readings_that_are_not_used_after_a_gap_are_in_no_residual_either():
    whole = log_of(RigParameters(kinetic_n_mm_per_mm=0.001), seconds=6.0)
    (one,) = whole.trials
    # Across the turn of a ramp: what the base did there is unknown.
    kept = (one["time_s"] < 1.0) | (one["time_s"] > 1.7)
    gapped = replace(one, table=one.table[kept].reset_index(drop=True))
    nominal = replay_nominal(replace(whole, trials=(gapped,)))
    (left,) = nominal.log.trials
    after = (gapped["time_s"] > 1.7) & (gapped["time_s"] < 2.7)  # it has forgotten after 1 s at least
    for sensor in ("tip_angle_deg", "base_torque_n_mm"):
        assert np.isnan(left[sensor][after]).all()
        assert np.isfinite(left[sensor][gapped["time_s"] < 1.0]).all()
        assert np.isfinite(gapped[sensor]).all()
    assert np.isfinite(left["base_angle_deg"]).all()

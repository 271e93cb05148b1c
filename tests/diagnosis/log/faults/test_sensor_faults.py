"""Saturated and frozen samples and outliers are set aside, with a warning."""

import re

import numpy as np
import pytest
from analytic_log import TURNS, at, change_trial, frozen

from diagnosis.log.faults.sensor_faults import without_faults
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import Trial

FAULTS = [
    (
        frozen("tip_angle_deg"),
        r"tip_angle_deg .*frozen.* 150 of 1200 samples, lines 302-451; .*not used",
    ),
    (frozen("base_torque_n_mm"), r"base_torque_n_mm .*frozen.*lines 302-451; .*not used"),
    (frozen("base_angle_deg"), r"base_angle_deg .*frozen.*lines 302-451; used as it is"),
    (lambda t: t.assign(tip_angle_deg=1.5), r"tip_angle_deg .*frozen.*1200 of 1200"),
    (
        lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=60)),
        r"tip_angle_deg .*saturated.*not used",
    ),
    (
        lambda t: t.assign(base_torque_n_mm=t["base_torque_n_mm"].clip(-0.5, 1)),
        r"base_torque_n_mm .*saturated",
    ),
    (
        at("tip_angle_deg", r200=150.0, r201=149.0, r500=-99.0),
        r"tip_angle_deg .*outliers.* 3 of .*lines 202-203, 502; .*not used",
    ),
    (at("base_angle_deg", r500=360.0), r"base_angle_deg .*outliers.*line 502; replaced"),
]


@pytest.mark.parametrize(("change", "said"), FAULTS)
def test_faulty_samples_are_named_with_a_warning(log, change, said):
    change_trial(log, change)
    found = read_rig_log(log)
    assert len(found.trials) == 2
    assert all("turns.csv" in warning for warning in found.warnings)
    assert any(re.search(said, warning) for warning in found.warnings), found.warnings


def test_faulty_samples_of_a_sensor_are_set_aside_and_no_others(log):
    change_trial(log, frozen("tip_angle_deg"))
    trial = read_rig_log(log).trials[0]
    empty = np.flatnonzero(np.isnan(trial["tip_angle_deg"]))
    np.testing.assert_array_equal(empty, np.arange(300, 450))
    assert not np.isnan(trial["base_torque_n_mm"]).any()


def test_beside_a_long_freeze_short_ones_count_as_well(log):
    def freezes(t):
        return frozen("tip_angle_deg", first=700, count=8)(frozen("tip_angle_deg")(t))

    change_trial(log, freezes)
    empty = np.flatnonzero(np.isnan(read_rig_log(log).trials[0]["tip_angle_deg"]))
    np.testing.assert_array_equal(empty, [*range(300, 450), *range(700, 708)])


def test_a_short_freeze_alone_may_be_chance(log):
    change_trial(log, frozen("tip_angle_deg", first=700, count=8))
    assert not np.isnan(read_rig_log(log).trials[0]["tip_angle_deg"]).any()


def test_an_outlier_of_the_base_is_replaced_by_what_its_neighbours_say(log):
    change_trial(log, at("base_angle_deg", r150=80.0))
    base = read_rig_log(log).trials[0]["base_angle_deg"]
    # A cubic through eight neighbours and more leaves 0.7 of their noise of 0.02 deg at the most.
    assert base[150] == pytest.approx(90 * 0.5, abs=3 * 0.02)


def test_at_an_end_of_a_trial_an_outlier_of_a_sensor_is_set_aside_and_the_base_is_kept(log):
    change_trial(log, at("tip_angle_deg", r1198=150.0, r1199=150.0))
    change_trial(log, at("base_angle_deg", r1199=360.0))
    trial = read_rig_log(log).trials[0]
    np.testing.assert_array_equal(np.isnan(trial["tip_angle_deg"][-4:]), [False, False, True, True])
    assert trial["base_angle_deg"][-1] == 360.0


def test_saturated_samples_are_set_aside(log):
    """No reading is left within a scatter of the limit, where half of them would be cut off."""
    change_trial(log, lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=60)))
    tip = read_rig_log(log).trials[0]["tip_angle_deg"]
    true = TURNS["tip_angle_deg"].to_numpy()
    assert np.isnan(tip[true > 60]).all()
    assert np.isfinite(tip[true < 50]).mean() > 0.98


def test_a_trial_without_faults_stays_as_it_is():
    trial = Trial(name="turns.csv", table=TURNS)
    found, warnings = without_faults(trial, {"base_angle_deg": 0.02, "tip_angle_deg": 0.4})
    assert warnings == []
    assert found.table.equals(TURNS)

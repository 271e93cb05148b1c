"""What is used with a warning."""

import re

import pytest
from analytic_log import change_rig, change_trial, scaled

from diagnosis.log.checks.plausibility import plausibility_warnings
from diagnosis.log.rig_log import read_rig_log

IMPLAUSIBLE = [
    (
        lambda t: t.drop(index=range(150, 200)),
        r"time_s jumps by up to 0.51 s before line 152; the base is taken to have moved smoothly",
    ),
    (
        lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"] + 4),
        r"tip_angle_deg starts away.*by [34].*offset of the sensor",
    ),
    (
        lambda t: t.assign(base_torque_n_mm=t["base_torque_n_mm"] + 0.15),
        r"base_torque_n_mm starts away from 0.*0.1",
    ),
    (lambda t: t.iloc[150:], r"tip_angle_deg starts away from base_angle_deg"),
    (lambda t: t.drop(columns="tip_angle_deg"), r"no reading of tip_angle_deg"),
]


@pytest.mark.parametrize(("change", "said"), IMPLAUSIBLE)
def test_doubtful_data_is_used_with_a_warning(log, change, said):
    change_trial(log, change)
    found = read_rig_log(log)
    assert len(found.trials) == 2
    assert all("turns.csv" in warning for warning in found.warnings)
    assert any(re.search(said, warning) for warning in found.warnings), found.warnings


OTHER_UNITS = [
    (lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"] / 57.3), r"tip_angle_deg turns 0.0.*radians"),
    (
        lambda t: t.assign(base_angle_deg=t["base_angle_deg"] / 57.3),
        r"tip_angle_deg turns [45].* times.*radians",
    ),
    (
        scaled("base_angle_deg", 1e-3),
        r"tip_angle_deg turns .* times as far as base_angle_deg; check the unit of base_angle_deg",
    ),
]


@pytest.mark.parametrize(("change", "said"), OTHER_UNITS)
def test_a_log_in_another_unit_is_used_with_a_warning(log, change, said):
    """All its trials are: of one alone the others say that its unit is wrong (test_other_units.py)."""
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, change, name)
    assert any(re.search(said, warning) for warning in read_rig_log(log).warnings)


@pytest.mark.parametrize(("column", "field"), [("tip_angle_deg", "tip_angle_noise_deg")])
def test_claims_that_a_sensor_cannot_keep_are_said(log, column, field):
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.assign(**{column: t[column].round()}), name)
    change_rig(log, lambda c: c["sensors"].update({field: 0.1}))
    assert any("smallest step is 1," in w and column in w for w in read_rig_log(log).warnings)
    change_rig(log, lambda c: c["sensors"].update({field: 0}))
    assert any("a noise of 0" in w and column in w for w in read_rig_log(log).warnings)


def test_a_good_log_raises_none(log):
    found = read_rig_log(log)
    assert plausibility_warnings(found.trials, found.rig.sensors.by_column()) == []


def test_a_base_that_rests_and_a_tip_that_drifts_by_a_few_degrees_are_not_compared(log):
    change_trial(
        log,
        lambda t: t.assign(
            base_angle_deg=0.02 * (t.index % 2),
            tip_angle_deg=t["tip_angle_deg"] / 20,
            base_torque_n_mm=t["base_torque_n_mm"] / 20,
        ),
    )
    assert not any("times as far" in warning for warning in read_rig_log(log).warnings)

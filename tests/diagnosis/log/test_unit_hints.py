"""Names in another spelling or unit."""

import pytest
from analytic_log import change_trial, refusal, renamed

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import COLUMNS
from diagnosis.log.unit_hints import look_alike, unit_off_by

NAMES = [
    ("tip_angle_deg", "tip_angle_rad", "multiply it by 57.2958 and rename it"),
    ("tip_angle_deg", "Tip Angle [deg]", "rename it"),
    ("tip_angle_deg", "tipAngle", "bring it to the unit"),
    ("tip_angle_deg", "angle_tip_deg", "rename it"),
    ("base_angle_deg", "Base Angle (rad)", "57.2958"),
    ("base_torque_n_mm", "base_torque_mNm", "rename it"),
    ("base_torque_n_mm", "base_torque_Nm", "multiply it by 1000"),
    ("base_torque_n_mm", "torque", "bring it to the unit"),
    ("time_s", "time_ms", "multiply it by 0.001"),
    ("time_s", "t", "expected time_s"),
    ("free_mm", "free_cm", "multiply it by 10"),
    ("inserted_mm", "insertion_mm", "rename it"),
    ("speed_mm_s", "speed_m_s", "multiply it by 1000"),
    ("speed_mm_s", "speed [mm/s]", "rename it"),
]


@pytest.mark.parametrize(("wanted", "found", "fix"), NAMES)
def test_a_column_of_another_name_or_unit_is_said_and_not_guessed(log, wanted, found, fix):
    change_trial(log, renamed(wanted, found))
    said = refusal(log)
    assert "turns.csv, line 1" in said
    assert f"{wanted!r} is missing" in said
    assert found in said
    assert fix in said


@pytest.mark.parametrize("name", ["temperature_c", "tip_x_mm", "motor_current_a", "base_speed_deg_s"])
def test_a_column_of_something_else_is_no_look_alike(log, name):
    change_trial(log, lambda t: t.drop(columns="tip_angle_deg").assign(**{name: 1.0}))
    assert not read_rig_log(log).trials[0].has("tip_angle_deg")


def test_a_look_alike_belongs_to_the_name_that_it_is_most_like():
    found = look_alike(["tip_torque_nm"], "tip_torque_n_mm", COLUMNS)
    assert found is not None
    assert found.factor == 1000
    assert look_alike(["tip_torque_nm"], "base_torque_n_mm", COLUMNS) is None


@pytest.mark.parametrize(
    ("column", "factor", "unit"),
    [
        ("tip_angle_deg", 60.0, "rad"),
        ("base_angle_deg", 0.05, "mrad"),
        ("base_torque_n_mm", 900.0, "N m"),
        ("base_torque_n_mm", 11.0, "N cm"),
        ("tip_angle_deg", 1000.0, None),
        ("base_torque_n_mm", 100.0, None),
    ],
)
def test_a_factor_tells_a_unit_within_half_and_twice(column, factor, unit):
    found = unit_off_by(column, factor)
    assert (found.name if found else None) == unit

"""Readings that scatter far less than claimed."""

import numpy as np
import pytest
from analytic_log import BASE, TIP, TORQUE, TURNS, change_trial, scaled

from diagnosis.log.checks.noise_claims import far_claims
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import Trial

NOISE = {"base_angle_deg": BASE, "base_torque_n_mm": TORQUE, "tip_angle_deg": TIP}


def trial(table):
    return Trial(name="turns.csv", table=table)


@pytest.mark.parametrize(
    ("column", "factor", "fix"),
    [
        ("tip_angle_deg", np.pi / 180, "if it is in rad, multiply it by 57.2958"),
        ("base_angle_deg", np.pi / 180, "if it is in rad, multiply it by 57.2958"),
        ("base_torque_n_mm", 1e-3, "if it is in N m, multiply it by 1000"),
        ("base_torque_n_mm", 0.1, "if it is in N cm, multiply it by 10"),
        ("base_angle_deg", 1e-3, "check its unit"),
    ],
)
def test_a_column_in_another_unit_is_named_with_its_factor(column, factor, fix):
    found = far_claims([trial(scaled(column, factor)(TURNS))], NOISE)
    assert list(found) == [column]
    assert f"turns.csv: {column} scatters by" in found[column]
    assert fix in found[column]


@pytest.mark.parametrize("column", NOISE)
@pytest.mark.parametrize("times", [40, 170])
def test_a_claim_far_above_the_readings_is_told(column, times):
    found = far_claims([trial(TURNS)], NOISE | {column: times * NOISE[column]})
    assert list(found) == [column]
    assert "else correct the claim" in found[column]


def test_claims_that_are_off_by_half_are_left_to_the_replay():
    assert far_claims([trial(TURNS)], {name: 2 * claim for name, claim in NOISE.items()}) == {}
    assert far_claims([trial(TURNS)], {name: claim / 40 for name, claim in NOISE.items()}) == {}
    assert far_claims([trial(TURNS)], dict.fromkeys(NOISE, 0.0)) == {}


def test_a_filtered_sensor_is_told(log):
    smooth = TURNS["tip_angle_deg"].rolling(40, min_periods=1).mean().round(1)
    change_trial(log, lambda t: t.assign(tip_angle_deg=smooth))
    (warning,) = read_rig_log(log).warnings
    assert "turns.csv: tip_angle_deg scatters" in warning
    assert "if it is filtered" in warning


def test_angles_in_radians_and_torque_in_newton_metres_are_both_told(log):
    for name in ("turns.csv", "slides.csv"):
        for column, factor in (
            ("base_angle_deg", 57.3),
            ("tip_angle_deg", 57.3),
            ("base_torque_n_mm", 1e3),
        ):
            change_trial(log, scaled(column, 1 / factor), name)
    said = "\n".join(read_rig_log(log).warnings)
    for column, unit in (
        ("base_angle_deg", "rad"),
        ("tip_angle_deg", "rad"),
        ("base_torque_n_mm", "N m"),
    ):
        assert f"turns.csv, slides.csv: {column} scatters" in said
        assert f"if it is in {unit}, multiply it by" in said


def test_a_column_of_which_one_trial_is_off_is_told():
    found = far_claims([trial(TURNS), trial(scaled("tip_angle_deg", 1 / 57.3)(TURNS))], NOISE)
    assert list(found) == ["tip_angle_deg"]

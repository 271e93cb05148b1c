"""Lengths that no needle can have, and lengths that disagree."""

import numpy as np
import pytest
from analytic_log import change_rig, change_trial, refusal, scaled

from diagnosis.log.checks.lengths import length_warnings
from diagnosis.log.rig_log import read_rig_log


def both_in_metres(t):
    return t.assign(inserted_mm=t["inserted_mm"] / 1000, free_mm=t["free_mm"] / 1000)


def deeper(by):
    """The depth grows steadily by so much, at a speed that says so."""

    def change(t):
        share = np.linspace(0, 1, len(t))
        speed = by / (t["time_s"].iloc[-1] - t["time_s"].iloc[0])
        return t.assign(inserted_mm=t["inserted_mm"] + by * share, speed_mm_s=speed)

    return change


def test_lengths_in_metres_are_refused_with_the_factor(log):
    change_trial(log, both_in_metres)
    said = refusal(log)
    assert "turns.csv: inserted_mm and free_mm together never exceed 0.17 mm" in said
    assert "diameter_mm (0.59)" in said
    assert "multiply them by 1000" in said


def test_a_depth_in_metres_alone_is_refused_with_the_factor(log):
    change_trial(log, scaled("inserted_mm", 1e-3))
    said = refusal(log)
    assert "turns.csv: inserted_mm never exceeds 0.1 mm" in said
    assert "multiply it by 1000" in said


def test_a_free_length_in_metres_alone_is_told(log):
    change_trial(log, scaled("free_mm", 1e-3))
    (warning,) = read_rig_log(log).warnings
    assert warning.startswith(
        "turns.csv: free_mm never exceeds 0.07 mm; if it is in metres, multiply it"
    )


def test_a_thick_shaft_a_needle_in_air_and_no_free_length_are_no_faults(log):
    change_rig(log, lambda c: c["needle"].update(diameter_mm=10, shear_modulus_gpa=0.01))
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.assign(inserted_mm=0.0), name)
    change_trial(log, lambda t: t.assign(free_mm=0.0, inserted_mm=100.0))
    said = [w for w in read_rig_log(log).warnings if "_mm " in w and "torque" not in w]
    assert said == []


def test_the_lengths_of_a_good_log_raise_no_alarm(log):
    assert [length_warnings(trial) for trial in read_rig_log(log).trials] == [[], []]


@pytest.mark.parametrize("column", ["inserted_mm", "free_mm"])
def test_a_length_that_alternates_is_refused(log, column):
    change_trial(log, lambda t: t.assign(**{column: np.where(t.index % 2, 10.0, 500.0)}))
    said = refusal(log)
    assert f"turns.csv: {column} jumps by up to 490 mm from one sample to the next" in said
    assert "correct these rows" in said


def test_a_stage_that_is_read_once_a_second_does_not_jump(log):
    """25 mm in ten seconds of a hold each: steps of 2.5 mm."""
    change_trial(
        log, lambda t: t.assign(inserted_mm=100 + t["free_mm"].iloc[0] - t["free_mm"]), "slides.csv"
    )
    change_trial(
        log,
        lambda t: t.assign(inserted_mm=t["inserted_mm"].iloc[t.index // 100 * 100].to_numpy()),
        "slides.csv",
    )
    assert read_rig_log(log).warnings == ()


def test_a_depth_that_the_free_length_does_not_give_is_told(log):
    change_trial(log, lambda t: deeper(300.0)(t).assign(free_mm=t["free_mm"] - 20 * t.index / len(t)))
    said = [w for w in read_rig_log(log).warnings if "inserted_mm grows" in w]
    assert len(said) == 1
    assert (
        "turns.csv: inserted_mm grows by 300 mm until line 1201, and free_mm gives 20 mm of that"
        in said[0]
    )


def test_a_depth_that_grows_out_of_the_free_length_is_no_fault(log):
    change_trial(log, lambda t: deeper(30.0)(t).assign(free_mm=t["free_mm"] - 30 * t.index / len(t)))
    assert read_rig_log(log).warnings == ()


def test_a_speed_that_the_free_length_does_not_follow_is_told(log):
    change_trial(log, lambda t: t.assign(speed_mm_s=2.0))
    (warning,) = read_rig_log(log).warnings
    assert "turns.csv: free_mm and speed_mm_s disagree" in warning
    assert "24 mm" in warning


def test_a_speed_of_the_wrong_sign_is_said(log):
    change_trial(log, scaled("speed_mm_s", -1), "slides.csv")
    (warning,) = read_rig_log(log).warnings
    assert "slides.csv: free_mm and speed_mm_s disagree" in warning
    assert "speed_mm_s seems to have the wrong sign" in warning

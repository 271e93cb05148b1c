"""How late starts are told."""

from dataclasses import replace

from diagnosis.prepare.start.late_start import LateStart, late_start_warning

TWISTED = LateStart(twist_deg=-34.6, rate_deg_s=0.2, unused_s=0.84)
MOVING = LateStart(twist_deg=5.0, rate_deg_s=-42.0, unused_s=0.5)


def test_one_warning_names_every_trial_its_twist_and_what_is_not_used():
    said = late_start_warning({"trial_02.csv": TWISTED, "trial_04.csv": MOVING})
    assert (
        "trial_02.csv by about 35 deg (its first 0.84 s are not used); trial_04.csv by about 5 deg"
        in said
    )
    assert "is fitted" in said


def test_a_base_that_moves_is_told():
    assert MOVING.words == "by about 5 deg and moving at 42 deg/s (its first 0.5 s are not used)"
    assert replace(MOVING, twist_deg=0.0).words == "moving at 42 deg/s (its first 0.5 s are not used)"
    assert replace(MOVING, unused_s=2e-5).words == "by about 5 deg and moving at 42 deg/s"
    assert replace(TWISTED, twist_deg=0.0).words == f"(its first {TWISTED.unused_s:.2g} s are not used)"


def test_trials_from_rest_raise_no_warning():
    assert late_start_warning({}) == ""

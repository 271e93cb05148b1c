"""How a late start is told."""

from diagnosis.prepare.late_start import LateStart


def test_the_warning_names_the_trial_the_twist_and_what_is_not_used():
    said = LateStart(twist_deg=-34.6, rate_deg_s=0.2, unused_s=0.84).warning("trial_02.csv")
    assert said.startswith("trial_02.csv: begins wound up by about 35 deg: ")
    assert "first 0.84 s is not used" in said


def test_a_base_that_moves_is_told():
    said = LateStart(twist_deg=5.0, rate_deg_s=-42.0, unused_s=0.5).warning("trial_01.csv")
    assert "wound up by about 5 deg, moving at 42 deg/s" in said

"""One recording under two names."""

import shutil

import pytest
from analytic_log import TURNS, change_rig, change_trial, lagging, refusal

from diagnosis.log.checks.repeated_trials import refuse_repeated_trials
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import Trial


def test_a_recording_under_two_names_is_refused(log):
    shutil.copy(log / "turns.csv", log / "again.csv")
    change_trial(log, lambda t: t.assign(time_s=t["time_s"] + 3), "again.csv")
    change_rig(log, lambda c: c["trials"].append({"file": "again.csv"}))
    said = refusal(log)
    assert "turns.csv and again.csv have the same samples" in said
    assert "take one of the two out of rig.yaml" in said


def test_the_same_motion_recorded_twice_is_two_trials(log):
    corners = ([0, 1, 2, 6, 7, 12], [0, 0, 90, 90, -30, -30])
    again = lagging(corners, 0.5)  # another seed
    assert len(again) == len(TURNS)
    again.to_csv(log / "again.csv", index=False)
    change_rig(log, lambda c: c["trials"].append({"file": "again.csv"}))
    assert read_rig_log(log).warnings == ()


@pytest.mark.parametrize("column", ["inserted_mm", "tip_angle_deg"])
def test_one_column_that_differs_makes_another_trial(tmp_path, column):
    """Simulated trials without noise may share a motion, and differ in depth alone."""
    other = TURNS.assign(**{column: TURNS[column] + 1})
    trials = [Trial(name=name, table=table) for name, table in (("a.csv", TURNS), ("b.csv", other))]
    refuse_repeated_trials([tmp_path / trial.name for trial in trials], trials)

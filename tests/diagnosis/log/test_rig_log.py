"""Reading a whole log."""

import numpy as np
import pytest
from analytic_log import SLIDES, TURNS, change_rig, change_trial, refusal

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog
from scripts.main import main


def test_a_good_log_is_read_without_a_warning(log):
    found = read_rig_log(log)
    assert found.warnings == ()
    assert [trial.name for trial in found.trials] == ["turns.csv", "slides.csv"]
    for trial, wrote in zip(found.trials, (TURNS, SLIDES), strict=True):
        for column in TURNS:
            np.testing.assert_array_equal(trial[column], wrote[column])


def test_nothing_of_the_users_is_changed(log):
    change_trial(log, lambda t: t.assign(tip_angle_deg=t["tip_angle_deg"].clip(upper=40)))
    before = {path: path.read_bytes() for path in log.iterdir()}
    assert read_rig_log(log).warnings
    assert {path: path.read_bytes() for path in log.iterdir()} == before


def test_the_command_refuses_with_2_and_one_message(log, capsys):
    change_trial(log, lambda t: t.drop(columns="free_mm"))
    assert main(["diagnose", str(log)]) == 2
    assert "free_mm" in capsys.readouterr().err


def test_a_log_without_any_sensor_is_refused(log):
    for name in ("turns.csv", "slides.csv"):
        change_trial(log, lambda t: t.drop(columns=["tip_angle_deg", "base_torque_n_mm"]), name)
    assert "base_torque_n_mm or tip_angle_deg" in refusal(log)


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(UnusableLog, match="nowhere"):
        read_rig_log(tmp_path / "nowhere")


def test_a_missing_trial_is_named(log):
    change_rig(log, lambda c: c.update(trials=[{"file": "trial_99.csv"}]))
    assert "trial_99.csv" in refusal(log)

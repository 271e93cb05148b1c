"""Reading and replaying a rig's log."""

import shutil
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
import yaml
from diagnosis.rig_log import UnusableLog, read_rig_log

from diagnosis.replay import replay

EXAMPLE = Path(__file__).parent.parent / "examples" / "rig-log"


@pytest.fixture
def log(tmp_path):
    folder = tmp_path / "log"
    shutil.copytree(EXAMPLE, folder)
    return folder


def edit_rig(folder, change):
    path = folder / "rig.yaml"
    content = yaml.safe_load(path.read_text())
    change(content)
    path.write_text(yaml.safe_dump(content))


def edit_trial(folder, change):
    path = folder / "trial_01.csv"
    change(pd.read_csv(path)).to_csv(path, index=False)


def test_the_example_rig_is_explained_by_the_nominal_needle():
    """An independent rig with nothing unmodelled: the residual is its sensors' noise."""
    found = read_rig_log(EXAMPLE)
    noise = found.rig.sensors
    for one in replay(found):
        # Claimed noise is good to about 15 %; thousands of samples scatter by 1 %.
        tip = np.std(one.residual("tip_angle_deg")) / noise.tip_angle_noise_deg
        torque = np.std(one.residual("base_torque_n_mm")) / noise.base_torque_noise_n_mm
        assert 0.85 < tip < 1.15
        assert 0.85 < torque < 1.15


def test_a_needle_that_is_not_the_rigs_leaves_a_gap(log):
    """Negative control: 20 % more damping is seen."""
    edit_rig(log, lambda c: c["tissue"].update(damping_n_mm_s_per_mm=1.2 * 0.0172))
    found = read_rig_log(log)
    noise = found.rig.sensors.base_torque_noise_n_mm
    gaps = [np.std(one.residual("base_torque_n_mm")) / noise for one in replay(found)]
    assert max(gaps) > 3


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda c: c.update(format="rig-log/2"), "rig-log/1"),
        (lambda c: c["needle"].pop("diameter_mm"), "diameter_mm"),
        (lambda c: c["needle"].update(diameter_mm=-1), "diameter_mm"),
        (lambda c: c["tissue"].update(damping="high"), "damping"),
        (lambda c: c.pop("sensors"), "sensors"),
        (lambda c: c.update(trials=[]), "trials"),
        (lambda c: c.update(trials=[{"file": "trial_99.csv"}]), "trial_99.csv"),
    ],
)
def test_what_is_wrong_with_rig_yaml_is_named(log, change, said):
    edit_rig(log, change)
    with pytest.raises(UnusableLog, match=said):
        read_rig_log(log)


@pytest.mark.parametrize("text", ["", "- a", "format: [", "\x00"])
def test_a_rig_yaml_that_cannot_be_read_is_refused(log, text):
    (log / "rig.yaml").write_text(text)
    with pytest.raises(UnusableLog, match=r"rig\.yaml"):
        read_rig_log(log)


def test_a_missing_folder_is_named(tmp_path):
    with pytest.raises(UnusableLog, match="nowhere"):
        read_rig_log(tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda t: t.drop(columns="free_mm"), "free_mm"),
        (lambda t: t.rename(columns={"base_angle_deg": "base_angle_rad"}), "base_angle_deg"),
        (lambda t: t.assign(inserted_mm=np.nan), r"line 2.*inserted_mm"),
        (lambda t: t.assign(time_s=0.0), "time_s"),
        (lambda t: t.iloc[::-1], "time_s"),
        (lambda t: t.head(1), "at least 20 rows"),
        (lambda t: t.assign(free_mm=-5.0), "free_mm"),
    ],
)
def test_what_is_wrong_with_a_trial_is_named(log, change, said):
    edit_trial(log, change)
    with pytest.raises(UnusableLog, match=f"(?s)trial_01.csv.*{said}"):
        read_rig_log(log)


def test_sensors_may_be_absent_or_empty(log):
    edit_trial(log, lambda t: t.drop(columns="tip_angle_deg").assign(base_torque_n_mm=np.nan))
    trial = read_rig_log(log).trials[0]
    assert not trial.has("tip_angle_deg")
    assert not trial.has("base_torque_n_mm")

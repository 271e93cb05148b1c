"""`needle import`, as a person runs it."""

import re

import numpy as np
import pytest
import yaml
from lab_files import KNOWN, LAB, mapping_of, write_csv, write_ros2

from diagnosis.log.rig_log import read_rig_log
from scripts import import_log
from scripts.main import main


@pytest.fixture(autouse=True)
def wide(monkeypatch):
    """A screen on which no line is broken."""
    monkeypatch.setenv("COLUMNS", "250")


def confirmed(path, **fill):
    """What a person does to a draft: take the marks out, fill the blanks."""
    text = re.sub(r"^ *guess: true.*\n", "", path.read_text(), flags=re.MULTILINE)
    for name, value in fill.items():
        text, count = re.subn(rf"^( *{name}:)( *#.*)?$", rf"\1 {value}", text, flags=re.MULTILINE)
        assert count == 1, name
    path.write_text(text)


RIG = {
    "diameter_mm": 0.59,
    "shear_modulus_gpa": 27.2,
    "density_g_cm3": 6.45,
    "damping_n_mm_s_per_mm": 0.017,
}


def test_from_a_file_to_a_log_by_way_of_an_edited_draft(tmp_path, capsys):
    source, out = str(write_csv(tmp_path)), tmp_path / "out"
    assert main(["import", source, "--out", str(out)]) == 0
    said = capsys.readouterr().out
    assert sorted(p.name for p in out.iterdir()) == ["mapping.yaml", "preview.png"]
    assert "to fill in: speed_mm_s" in said
    assert "base_torque_noise_n_mm" in said
    mapping = out / "mapping.yaml"
    log = tmp_path / "log"
    command = ["import", source, "--map", str(mapping), "--out", str(log)]
    assert main(command) == 2
    assert "delete 'guess: true'" in capsys.readouterr().err
    assert not log.exists()
    confirmed(mapping, **RIG)
    assert main(command) == 2
    assert "constants.speed_mm_s" in capsys.readouterr().err
    confirmed(mapping, speed_mm_s=0)
    assert main(command) == 0
    said = capsys.readouterr().out
    assert "read back: 1 trial, no warnings" in said
    trial = read_rig_log(log).trials[0]
    for name in ("base_torque_n_mm", "tip_angle_deg", "base_angle_deg"):
        # The zero was guessed from 80 samples at rest: good to a tenth of their noise, four of these.
        noise = {"base_torque_n_mm": 0.015, "tip_angle_deg": 0.4, "base_angle_deg": 0.02}[name]
        np.testing.assert_allclose(trial[name], KNOWN[name], atol=0.4 * noise + 1e-6, err_msg=name)


def test_guesses_are_accepted_only_on_request(tmp_path, capsys):
    source = str(write_csv(tmp_path))
    content = mapping_of(["run.csv"])
    content["columns"]["tip_angle_deg"]["guess"] = True
    mapping = tmp_path / "mine.yaml"
    mapping.write_text(yaml.safe_dump(content))
    command = ["import", source, "--map", str(mapping), "--out", str(tmp_path / "log")]
    assert main(command) == 2
    assert "columns.tip_angle_deg" in capsys.readouterr().err
    assert main([*command, "--accept-guesses"]) == 0


def test_three_columns_that_cannot_be_mapped_are_named_in_one_run(tmp_path, capsys):
    table = LAB.rename(columns={"motor angle [rad]": "disp (in)", "torque (N m)": "force (kip)"})
    assert main(["import", str(write_csv(tmp_path, table)), "--out", str(tmp_path / "out")]) == 0
    said = [line for line in capsys.readouterr().out.splitlines() if line.startswith("to fill in:")]
    for name in ("disp (in)", "force (kip)", "speed_mm_s"):
        assert any(name in line for line in said), name


def test_an_unknown_unit_is_said_in_words(tmp_path, capsys):
    table = LAB.rename(columns={"torque (N m)": "torque"})
    assert main(["import", str(write_csv(tmp_path, table)), "--out", str(tmp_path / "out")]) == 0
    said = capsys.readouterr().out
    assert "None" not in said
    assert "unknown: fill in" in said


def test_warnings_of_the_log_are_shown(tmp_path, capsys):
    content = mapping_of(["run.csv"])
    content["columns"]["base_torque_n_mm"]["zero"] = 0.0
    mapping = tmp_path / "mine.yaml"
    mapping.write_text(yaml.safe_dump(content))
    source = str(write_csv(tmp_path))
    assert main(["import", source, "--map", str(mapping), "--out", str(tmp_path / "log")]) == 0
    assert "warning: trial_00.csv: base_torque_n_mm starts away from 0" in capsys.readouterr().out


def test_nothing_of_the_users_is_replaced(tmp_path, capsys):
    """Neither a file that exists, nor by `--force` a source that has the name of a trial."""
    source = write_csv(tmp_path).rename(tmp_path / "trial_00.csv")
    before = source.read_bytes()
    mapping = tmp_path / "mapping.yaml"
    mapping.write_text(yaml.safe_dump(mapping_of(["trial_00.csv"])))
    edited = mapping.read_bytes()
    assert main(["import", str(source), "--out", str(tmp_path)]) == 2
    assert "--force" in capsys.readouterr().err
    command = ["import", str(source), "--map", str(mapping), "--out", str(tmp_path), "--force"]
    assert main(command) == 2
    assert "another folder" in capsys.readouterr().err
    assert (source.read_bytes(), mapping.read_bytes()) == (before, edited)
    assert sorted(p.name for p in tmp_path.iterdir()) == ["mapping.yaml", "trial_00.csv"]


def test_a_log_that_would_be_refused_replaces_none(tmp_path, capsys):
    content = mapping_of(["run.csv"])
    source, mapping, log = write_csv(tmp_path), tmp_path / "mine.yaml", tmp_path / "log"
    command = ["import", str(source), "--map", str(mapping), "--out", str(log), "--force"]
    mapping.write_text(yaml.safe_dump(content))
    assert main(command) == 0
    before = {path: path.read_bytes() for path in log.iterdir()}
    column = content["columns"]["base_torque_n_mm"]
    column["sign"] = -column.get("sign", 1)
    mapping.write_text(yaml.safe_dump(content))
    capsys.readouterr()
    assert main(command) == 2
    said = capsys.readouterr()
    assert "nothing was written" in said.err
    assert "wrote" not in said.out
    assert {path: path.read_bytes() for path in log.iterdir()} == before


@pytest.mark.parametrize("change", ["missing", "text", "unknown column"])
def test_bad_input_exits_2_and_names_the_file(tmp_path, capsys, change):
    source = write_csv(tmp_path)
    content = mapping_of(["run.csv"])
    if change == "missing":
        source = tmp_path / "gone.csv"
    elif change == "text":
        source.write_text("hello")
    else:
        content["columns"]["free_mm"]["column"] = "gone"
    mapping = tmp_path / "mine.yaml"
    mapping.write_text(yaml.safe_dump(content))
    command = ["import", str(source), "--map", str(mapping), "--out", str(tmp_path / "log")]
    assert main(command) == 2
    assert re.search("gone|run.csv", capsys.readouterr().err)


def test_a_bag_of_topics_is_drafted_and_imported(tmp_path):
    source, out = str(write_ros2(tmp_path, torque_late_s=0.8)), tmp_path / "out"
    assert main(["import", source, "--out", str(out)]) == 0
    confirmed(out / "mapping.yaml", inserted_mm=100, free_mm=70, speed_mm_s=0, **RIG)
    log = tmp_path / "log"
    assert main(["import", source, "--map", str(out / "mapping.yaml"), "--out", str(log)]) == 0
    trial = read_rig_log(log).trials[0]
    rows = trial["time_s"].size
    assert trial["time_s"][-1] == pytest.approx(KNOWN["time_s"].iloc[rows - 1], abs=1e-6)
    assert callable(import_log.run)

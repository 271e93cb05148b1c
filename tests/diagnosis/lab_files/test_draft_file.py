"""The text of a draft is YAML that a person edits, and no log as it stands."""

import pytest
import yaml
from lab_files import LAB, write_csv, write_ros2

from diagnosis.lab_files.draft_file import loop_lines, mapping_text
from diagnosis.lab_files.guesses.draft import drafted
from diagnosis.lab_files.read_mapping import read_mapping
from diagnosis.lab_files.readers.read import read_lab_files
from models.errors import InvalidValue


def draft_of(path):
    return drafted(read_lab_files([path]))


def test_a_draft_is_refused_until_it_is_edited(tmp_path):
    path = tmp_path / "mapping.yaml"
    path.write_text(mapping_text(draft_of(write_csv(tmp_path))))
    with pytest.raises(InvalidValue) as caught:
        read_mapping(path, accept_guesses=False)
    for place in (
        "columns.base_angle_deg: delete 'guess: true'",
        "needle.diameter_mm",
        "constants.speed",
    ):
        assert place in str(caught.value)


def test_accepting_guesses_does_not_fill_blanks(tmp_path):
    path = tmp_path / "mapping.yaml"
    path.write_text(mapping_text(draft_of(write_csv(tmp_path))))
    with pytest.raises(InvalidValue) as caught:
        read_mapping(path, accept_guesses=True)
    assert "guess" not in str(caught.value).split("in it:")[1]
    assert "needle.diameter_mm" in str(caught.value)


@pytest.mark.parametrize("write", [write_csv, write_ros2])
def test_the_text_holds_every_guess_of_the_draft(tmp_path, write):
    draft = draft_of(write(tmp_path))
    content = yaml.safe_load(mapping_text(draft))
    for column in draft.columns:
        entry = content["columns"][column.wanted]
        assert entry["column"] == column.source.column
        assert entry["sign"] == column.source.sign
        assert entry["zero"] == column.source.zero
        assert entry["time_offset_s"] == column.source.time_offset_s
        assert entry["guess"] is True
    assert content.get("resample_hz") == draft.resample_hz
    assert content["sensors"] == dict(draft.noise)
    assert content["needle"] == dict.fromkeys(content["needle"])


def test_every_reason_stands_beside_its_guess(tmp_path):
    draft = draft_of(write_csv(tmp_path))
    text = mapping_text(draft)
    for column in draft.columns:
        for reason in column.reasons.values():
            assert reason in text
    for time in draft.times:
        assert f'{time.source.column}"  # {time.because}' in text


def test_the_line_of_the_inertia_is_one_to_take_the_mark_off(tmp_path):
    text = mapping_text(draft_of(write_csv(tmp_path)))
    assert "inertia" not in yaml.safe_load(text)
    content = yaml.safe_load(text.replace("# inertia:", "inertia:"))
    assert content["inertia"] == {"base_kg_m2": 0.0, "tip_kg_m2": 0.0}


def test_milliseconds_that_can_only_be_seconds_are_a_blank(tmp_path):
    table = LAB.assign(**{"t (ms)": LAB["t (ms)"] / 1000})
    draft = draft_of(write_csv(tmp_path, table))
    (time,) = yaml.safe_load(mapping_text(draft))["times"]
    assert time["unit"] is None
    assert any("times.t (ms): 'ms' in the name" in item for item in draft.open)


def test_a_candidate_for_the_tip_is_a_comment_and_no_guess(tmp_path):
    table = LAB.rename(columns={"tip camera (deg)": "second angle (deg)"})
    draft = draft_of(write_csv(tmp_path, table))
    text = mapping_text(draft)
    assert "tip_angle_deg" not in yaml.safe_load(text)["columns"]
    assert any("second angle" in item and "is it at the tip?" in item for item in draft.open)
    columns = yaml.safe_load(text.replace("  # tip_angle_deg:", "  tip_angle_deg:"))["columns"]
    assert columns["tip_angle_deg"] == {"column": "second angle (deg)", "unit": "deg", "sign": 1}


def test_an_odd_name_survives(tmp_path):
    name = 'torque: "N m" # it\'s [odd]'
    table = LAB.rename(columns={"torque (N m)": name})
    content = yaml.safe_load(mapping_text(draft_of(write_csv(tmp_path, table, separator="\t"))))
    assert content["columns"]["base_torque_n_mm"]["column"].startswith("torque: ")


def test_a_missing_base_angle_is_a_blank_entry(tmp_path):
    draft = draft_of(write_csv(tmp_path, LAB.drop(columns=["motor angle [rad]"])))
    content = yaml.safe_load(mapping_text(draft))
    assert content["columns"]["base_angle_deg"] == {"column": None, "unit": None}
    assert "base_angle_deg" not in content["constants"]
    assert loop_lines(draft) == []


def test_where_the_scale_is_open_the_noise_is_told_in_the_unit_of_the_file(tmp_path):
    table = LAB.rename(columns={"torque (N m)": "torque (V)"})
    text = mapping_text(draft_of(write_csv(tmp_path, table)))
    assert yaml.safe_load(text)["sensors"]["base_torque_noise_n_mm"] is None
    line = next(line for line in text.splitlines() if "base_torque_noise_n_mm" in line)
    assert "times the factor: 1.4" in line  # 0.015 N mm, good to 2.4 %, in thousandths of a volt
    assert "e-05 V" in line


def test_without_a_sensor_its_noise_is_any_number(tmp_path):
    draft = draft_of(write_csv(tmp_path, LAB.drop(columns=["tip camera (deg)"])))
    assert yaml.safe_load(mapping_text(draft))["sensors"]["tip_angle_noise_deg"] == 1.0

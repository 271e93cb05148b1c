"""Drafts of files whose content is known."""

import numpy as np
import pytest
from lab_files import LAB, TORQUE_ZERO_N_M, write_csv, write_mat, write_ros2

from diagnosis.lab_files.guesses.draft import NOISES, drafted
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.log.nominal_rig import SensorNoise


def draft_of(*paths):
    draft = drafted(read_lab_files(paths))
    return draft, {column.wanted: column for column in draft.columns}


def test_the_draft_of_a_known_file_is_right(tmp_path):
    """Signs, zero and units are those that `lab_files.mapping_of` has."""
    draft, columns = draft_of(write_csv(tmp_path))
    sources = {name: column.source for name, column in columns.items()}
    assert sources["base_angle_deg"].unit == "rad"
    assert sources["base_torque_n_mm"].sign == -1
    assert sources["base_torque_n_mm"].zero == pytest.approx(TORQUE_ZERO_N_M, abs=1e-5)
    assert sources["tip_angle_deg"].sign == 1
    assert sources["inserted_mm"].unit == "cm"
    assert {source.guess for source in sources.values()} == {True}
    assert draft.times[0].source.unit == "ms"
    assert draft.resample_hz is None
    assert draft.noise["base_torque_noise_n_mm"] == pytest.approx(0.015, rel=0.1)


def test_what_is_missing_is_open_and_the_rest_is_not(tmp_path):
    draft, _ = draft_of(write_csv(tmp_path))
    assert [item.split(":")[0] for item in draft.open] == ["free_mm", "speed_mm_s", "needle, tissue"]


def test_every_guess_has_a_reason(tmp_path):
    _, columns = draft_of(write_csv(tmp_path))
    for column in columns.values():
        assert {"column", "unit", "sign"} <= set(column.reasons), column.wanted
        assert all(column.reasons.values())


def test_topics_of_ros_are_drafted_with_a_rate_and_the_offset_of_a_late_clock(tmp_path):
    draft, columns = draft_of(write_ros2(tmp_path, torque_late_s=0.8))
    assert columns["base_angle_deg"].source.column == "/joint_states.position[0]"
    assert columns["base_torque_n_mm"].source.column == "/wrench.wrench.torque.z"
    assert columns["base_torque_n_mm"].source.time_offset_s == pytest.approx(-0.8, abs=0.1)
    assert columns["tip_angle_deg"].source.time_offset_s == 0
    assert draft.resample_hz == pytest.approx(100)
    assert all(time.source.column.endswith("header.stamp") for time in draft.times)


def test_a_file_of_nothing_known_gives_a_draft_and_no_error(tmp_path):
    table = LAB[["free"]].assign(b=np.arange(len(LAB))[::-1])
    draft, columns = draft_of(write_csv(tmp_path, table.rename(columns={"free": "a"})))
    assert columns == {}
    assert draft.unused == ("a", "b")
    assert len(draft.open) >= 5


def test_missing_times_are_asked_for_once(tmp_path):
    draft, columns = draft_of(write_csv(tmp_path, LAB.drop(columns=["t (ms)"])))
    assert len(columns) > 3
    assert len([item for item in draft.open if "sample_hz" in item]) == 1


def test_a_mat_file_without_names_of_units_is_asked_about(tmp_path):
    draft, _ = draft_of(write_mat(tmp_path))
    assert not any("'run.torque_n_m'" in item for item in draft.open)
    assert draft.times[0].source.column == "run.t_ms"


def test_every_noise_of_rig_yaml_has_its_column():
    assert set(NOISES) == set(SensorNoise.model_fields)

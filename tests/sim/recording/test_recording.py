"""Recordings on disk: complete, exact, never over somebody's data."""

from dataclasses import replace

import numpy as np
import pandas as pd
import pytest

from models.errors import InvalidValue, OutputExists
from sim.recording.recording import Recording, UnreadableRecording, read, unit_of


def test_parquet_keeps_every_bit_and_every_parameter(recording, tmp_path):
    path = tmp_path / "run.parquet"
    recording.write(path)
    back = read(path)
    pd.testing.assert_frame_equal(back.table, recording.table, check_exact=True)
    assert back.parameters == recording.parameters


def test_csv_keeps_nine_digits(recording, tmp_path):
    path = tmp_path / "run.csv"
    recording.write(path)
    back = read(path)
    assert list(back.table.columns) == list(recording.table.columns)
    np.testing.assert_allclose(back.table, recording.table, rtol=1e-8, atol=1e-12)
    assert back.parameters == recording.parameters


def test_every_signal_ends_in_its_unit(recording):
    assert unit_of("base_torque_n_mm") == "N mm"
    assert unit_of("speed_mm_s") == "mm/s"
    assert all(unit_of(name) for name in recording.table.columns)
    with pytest.raises(InvalidValue, match="torque"):
        unit_of("torque")


def test_an_unknown_signal_is_answered_with_the_known_ones(recording):
    with pytest.raises(InvalidValue, match="tip_angle_deg"):
        recording["tip"]


def test_a_group_holds_its_numbered_signals_alone(recording):
    assert "tissue_energy_mj" in recording.table
    sites = [c for c in recording.table if c.startswith("tissue_") and c.endswith("_deg")]
    assert recording.group("tissue").shape[1] == len(sites)


def test_nothing_is_overwritten_unless_forced(recording, tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("mine")
    with pytest.raises(OutputExists, match="--force"):
        recording.write(path)
    assert path.read_text() == "mine"
    recording.write(path, force=True)
    assert read(path).parameters


def test_another_ending_is_refused(recording, tmp_path):
    with pytest.raises(InvalidValue, match=r"\.csv or \.parquet"):
        recording.write(tmp_path / "run.xlsx")


@pytest.mark.parametrize("text", ["", "time_s,a\n1,2\n", "# {}\ntime_s\n1\n", "# not json\n"])
def test_a_file_that_is_no_recording_is_refused(tmp_path, text):
    path = tmp_path / "other.csv"
    path.write_text(text)
    with pytest.raises(UnreadableRecording, match=r"other\.csv"):
        read(path)


def test_a_table_without_time_is_refused():
    with pytest.raises(InvalidValue, match="time_s"):
        Recording(table=pd.DataFrame({"tip_angle_deg": [1.0]}))


def test_a_recording_says_everything_that_the_run_depended_on(recording):
    assert set(recording.parameters) >= {"needle", "tissue", "drive", "discretisation", "mesh"}
    assert recording.parameters["mesh"] == "tissue"
    assert recording.parameters["discretisation"]["slip"] == "material"
    assert recording.parameters["needle"]["shear_modulus_gpa"] == 27.2


def test_a_notebook_shows_what_was_run_and_escapes_it(recording):
    evil = replace(recording, parameters={"description": "<script>"})
    shown = evil._repr_html_()
    assert "&lt;script&gt;" in shown
    assert "<script>" not in shown
    assert all(f"<th>{name}</th>" in shown for name in recording.names[1:])
    assert f"{recording['tip_angle_deg'][-1]:.4g}" in shown

"""Recordings on disk: whole, exact, never over somebody's data; and in rerun."""

import numpy as np
import pandas as pd
import pytest
from rerun.chunk import RrdReader

from models.errors import InvalidValue, OutputExists
from models.modes import InsertedNeedle
from models.needle import NITINOL
from sim.experiment import perform
from sim.files import writing
from sim.paper_protocols import protocol_named
from sim.recording.recording import Recording, UnreadableRecording, read, unit_of
from sim.recording.rerun_log import log_recording, modal_amplitudes_deg
from sim.recording.rerun_table import NotARecording, entries


@pytest.fixture(scope="module")
def recording():
    return perform(protocol_named("fig5-10cm"))


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


def test_an_interrupted_write_leaves_nothing_behind(tmp_path):
    path = tmp_path / "run.csv"
    with pytest.raises(KeyboardInterrupt), writing(path) as part:
        part.write_text("half")
        raise KeyboardInterrupt
    assert list(tmp_path.iterdir()) == []


def test_an_interrupted_replacement_leaves_the_old_file(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("old")
    with pytest.raises(RuntimeError), writing(path, force=True) as part:
        part.write_text("half")
        raise RuntimeError
    assert path.read_text() == "old"
    assert list(tmp_path.iterdir()) == [path]


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


def test_the_rerun_file_holds_the_signals_to_the_last_bit(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path, verdicts=["checked"])
    scalars, text = {}, ""
    for chunk in RrdReader(str(path)).stream():
        batch = chunk.to_record_batch()
        if "Scalars:scalars" in batch.schema.names:
            values = np.concatenate(batch.column("Scalars:scalars").to_pylist())
            scalars[str(chunk.entity_path)] = values
        if "TextDocument:text" in batch.schema.names:
            text = str(batch.column("TextDocument:text")[0])
    for name in ("base_angle_deg", "tip_angle_deg"):
        assert np.array_equal(scalars[f"/angles/{name}"], recording[name])
    assert np.array_equal(scalars["/torque/base_torque_n_mm"], recording["base_torque_n_mm"])
    assert "checked" in text
    assert "nitinol-0.59" in text


def test_the_rerun_file_shows_needle_tissue_modes_and_profiles(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    found = {(e.entity, e.component): e for e in entries(path)}
    for entity, component in (
        ("/world/bevel", "Arrows3D:vectors"),
        ("/world/shaft", "LineStrips3D:strips"),
        ("/world/tissue", "Boxes3D:half_sizes"),
        ("/profile/shaft", "BarChart:values"),
        ("/profile/tissue", "BarChart:values"),
        ("/modes/1", "Scalars:scalars"),
        ("/lengths/inserted_mm", "Scalars:scalars"),
    ):
        entry = found[entity, component]
        assert entry.rows > 100
        assert entry.end_s == pytest.approx(recording["time_s"][-1], abs=0.06)


def test_the_file_is_arranged_by_a_blueprint(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    assert RrdReader(str(path)).blueprints()


def test_a_rerun_file_is_not_overwritten(recording, tmp_path):
    path = tmp_path / "run.rrd"
    path.write_bytes(b"mine")
    with pytest.raises(OutputExists):
        log_recording(recording, path)
    assert path.read_bytes() == b"mine"


@pytest.mark.parametrize("content", [None, b"", b"not a recording"])
def test_what_is_no_rerun_file_is_refused(tmp_path, content):
    path = tmp_path / "x.rrd"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(NotARecording, match=r"x\.rrd"):
        entries(path)


def test_modal_amplitudes_are_those_of_the_closed_form():
    viscous = protocol_named("fig5-10cm").but(
        tissue="viscous-plastisol",
        segments=[{"duration_s": 0.3, "turn_deg": 90}, {"duration_s": 2}],
        discretisation={"elements": 32},
    )
    recording = perform(viscous)
    held = InsertedNeedle(
        needle=NITINOL,
        damping_n_mm_s_per_mm=viscous.tissue.layers[0].interface.viscous_n_mm_s_per_mm,
        inserted_mm=100,
        free_mm=50,
    )
    exact = held.respond(recording["time_s"], np.radians(recording["base_angle_deg"]))
    amplitudes = modal_amplitudes_deg(recording)
    assert np.abs(amplitudes[:, 0] - np.degrees(exact.modes_rad[:, 0])).max() < 0.05

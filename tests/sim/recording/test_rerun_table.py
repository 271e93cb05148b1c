"""The content of a rerun file, listed."""

import pytest
import rerun as rr

from sim.recording.rerun_log import log_recording
from sim.recording.rerun_table import NotARecording, entries


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
        assert entry.rows >= 20 * recording["time_s"][-1]  # frames a second
        assert entry.end_s == pytest.approx(recording["time_s"][-1], abs=0.06)


@pytest.mark.parametrize("content", [None, b"", b"not a recording"])
def test_what_is_no_rerun_file_is_refused(tmp_path, content):
    path = tmp_path / "x.rrd"
    if content is not None:
        path.write_bytes(content)
    with pytest.raises(NotARecording, match=r"x\.rrd"):
        entries(path)


def test_signals_are_listed_with_their_samples_and_last_value(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    listed = {e.entity: e for e in entries(path) if e.component == "Scalars:scalars"}
    tip = listed["/angles/tip_angle_deg"]
    assert tip.rows == recording["time_s"].size
    assert (tip.start_s, tip.last) == (0.0, pytest.approx(recording["tip_angle_deg"][-1]))
    units = {"/lengths/inserted_mm": "mm", "/torque/base_torque_n_mm": "N mm", "/modes/1": "deg"}
    assert tip.unit == "deg"
    assert {entity: listed[entity].unit for entity in units} == units


def test_only_what_was_recorded_is_listed(recording, tmp_path):
    """Not the date in nanoseconds that rerun notes, nor colours as numbers."""
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    found = entries(path)
    assert not [e for e in found if "start_time" in e.component or ("colors" in e.component and e.last)]
    latest_s = recording["time_s"][-1]
    assert max(e.end_s for e in found if e.end_s is not None) == pytest.approx(latest_s)


def test_a_timeline_of_another_program_that_counts_from_the_start_is_used(tmp_path):
    path = tmp_path / "other.rrd"
    stream = rr.RecordingStream("other")
    stream.save(path)
    stream.set_time("elapsed", duration=2.5)
    stream.log("residual/tip_angle_deg", rr.Scalars(3.0))
    stream.disconnect()
    (entry,) = entries(path)
    assert (entry.start_s, entry.end_s, entry.unit) == (2.5, 2.5, "σ")

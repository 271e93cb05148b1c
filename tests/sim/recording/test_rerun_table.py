"""The content of a rerun file, listed."""

import pytest

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

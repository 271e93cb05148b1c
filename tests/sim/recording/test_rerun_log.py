"""The rerun file of a recording: every signal to the last bit, with a layout."""

import numpy as np
import pytest
from rerun.chunk import RrdReader

from models.errors import OutputExists
from sim.recording.rerun_log import log_recording


def test_the_rerun_file_holds_the_signals_to_the_last_bit(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path, results=["checked"])
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

"""The needle in 3-D: bars along the shaft, and the path of a steered tip."""

from unittest.mock import Mock

import numpy as np
from rerun.chunk import RrdReader

from sim.recording.recording import Recording
from sim.recording.rerun_log import log_recording
from sim.recording.rerun_shaft import log_path
from sim.recording.shaft_places import node_places_mm


def last_bars(path):
    """Places and widths of the last bars, by entity."""
    places, widths = {}, {}
    for chunk in RrdReader(str(path)).stream():
        batch, entity = chunk.to_record_batch(), str(chunk.entity_path)
        if "BarChart:abscissa" in batch.schema.names:
            buffer = batch.column("BarChart:abscissa")[-1].as_py()[0]["buffer"]
            places[entity] = np.asarray(buffer)
            widths[entity] = np.asarray(batch.column("BarChart:widths")[-1].as_py())
    return places, widths


def test_bars_touch_at_most(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    places, widths = last_bars(path)
    for entity, at in places.items():
        half = widths[entity] / 2
        gaps = (at[1:] - half[1:]) - (at[:-1] + half[:-1])
        assert (half > 0).all()
        assert gaps.min() > -1e-3  # mm, in single precision
        assert gaps.min() < 1e-3


def test_bars_are_at_their_places_along_the_shaft(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    last, _ = last_bars(path)
    places = node_places_mm(recording)[-1]
    np.testing.assert_allclose(last["/profile/shaft"], places, atol=1e-4)
    sites = last["/profile/tissue"].reshape(-1, 2)
    assert ((places[:-1] < sites[:, 0]) & (sites[:, 1] < places[1:])).all()


def test_the_path_of_a_tip_is_logged_where_there_is_one(recording):
    stream = Mock()
    log_path(stream, recording)
    assert stream.mock_calls == []
    columns = {f"path_{axis}_mm": np.arange(len(recording.table)) for axis in "xyz"}
    steered = Recording(table=recording.table.assign(**columns), parameters=recording.parameters)
    log_path(stream, steered)
    assert [call.args[0] for call in stream.mock_calls] == ["world/path", "world/tip"]

"""The rerun file of a recording: every signal to the last bit, arranged, with modes."""

import numpy as np
import pytest
from rerun.chunk import RrdReader

from models.errors import OutputExists
from models.modes import InsertedNeedle
from models.needle import NITINOL
from sim.experiment import perform
from sim.paper_protocols import protocol_named
from sim.recording.recording import Recording
from sim.recording.rerun_log import application, log_recording, modal_amplitudes_deg
from sim.recording.shaft_places import node_places_mm


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


def test_the_file_is_arranged_by_a_blueprint(recording, tmp_path):
    path = tmp_path / "run.rrd"
    log_recording(recording, path)
    assert RrdReader(str(path)).blueprints()


def test_recordings_with_other_views_are_another_application(recording):
    """A viewer that has shown the one would show the other in its layout."""
    table = recording.table
    shaftless = table[[c for c in table if not c.startswith("shaft_0")]]
    controlled = table.assign(rate_limited_count=0.0)
    names = {
        application(Recording(table=one, parameters=recording.parameters))
        for one in (table, shaftless, controlled)
    }
    assert len(names) == 3
    assert application(recording) in names


def test_a_rerun_file_is_not_overwritten(recording, tmp_path):
    path = tmp_path / "run.rrd"
    path.write_bytes(b"mine")
    with pytest.raises(OutputExists):
        log_recording(recording, path)
    assert path.read_bytes() == b"mine"


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


def test_without_damping_there_are_no_modes_to_show():
    short = [{"duration_s": 0.1, "turn_deg": 9}]
    dry = perform(protocol_named("fig4-10cm").but(segments=short))
    assert modal_amplitudes_deg(dry) is None

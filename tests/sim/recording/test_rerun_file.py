"""A recording is whole when it has its name, and has none if it is not."""

import errno
import os
from pathlib import Path

import pytest
import rerun as rr
import rerun.blueprint as rrb
from rerun.chunk import RrdReader

from models.errors import OutputExists, UnwritableOutput
from sim.recording import rerun_file
from sim.recording.rerun_file import recorded

LAYOUT = rrb.Blueprint(rrb.TextDocumentView(origin="/about"))


def record(path, **how):
    with recorded("test", LAYOUT, path, **how) as stream:
        stream.log("about", rr.TextDocument("torsion"), static=True)


def test_the_file_has_its_content_its_layout_and_its_list_of_content(tmp_path):
    path = tmp_path / "run.rrd"
    record(path)
    reader = RrdReader(str(path))
    assert "/about" in {str(chunk.entity_path) for chunk in reader.store().stream()}
    assert reader.blueprints()


@pytest.mark.filterwarnings("ignore:RRD file has no footer")
@pytest.mark.parametrize("lost", [1, 20, 400])
def test_a_file_that_was_cut_off_gets_no_name(tmp_path, monkeypatch, lost):
    write = Path.write_bytes
    monkeypatch.setattr(Path, "write_bytes", lambda self, data: write(self, data[:-lost]))
    with pytest.raises(UnwritableOutput, match=r"run\.rrd: incomplete when read back"):
        record(tmp_path / "run.rrd")
    assert list(tmp_path.iterdir()) == []


def test_a_disk_that_is_full_is_an_error_and_leaves_no_file(tmp_path, monkeypatch):
    def full(path, data):
        path.open("wb").write(data[:100])
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(UnwritableOutput, match="No space left on device; free some space"):
        record(tmp_path / "run.rrd")
    assert list(tmp_path.iterdir()) == []


def test_nothing_is_recorded_over_a_file_unasked(tmp_path, monkeypatch):
    path = tmp_path / "run.rrd"
    path.write_text("mine")
    with pytest.raises(OutputExists):
        record(path)
    assert path.read_text() == "mine"
    record(path, force=True)
    rerun_file._refuse_incomplete(path, path)

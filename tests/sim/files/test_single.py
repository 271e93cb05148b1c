"""One file is written whole or not at all, and never over another unasked."""

import pytest

from models.errors import OutputExists
from sim.files import Destination, publishing
from sim.files.single import write_text, writing


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


def test_a_finished_write_makes_folders_and_a_file_that_others_may_read(tmp_path):
    path = tmp_path / "new" / "folder" / "note.txt"
    write_text(path, "torsion, 45\u00b0")
    assert path.read_text(encoding="utf-8") == "torsion, 45\u00b0"
    assert path.stat().st_mode & 0o777 == 0o644
    assert list(path.parent.iterdir()) == [path]


def test_an_existing_file_is_replaced_if_asked_to_alone(tmp_path):
    path = tmp_path / "there.csv"
    path.write_text("mine")
    with pytest.raises(OutputExists, match=r"there\.csv exists.*--force"):
        write_text(path, "theirs")
    assert path.read_text() == "mine"
    write_text(path, "theirs", force=True)
    assert path.read_text() == "theirs"


def test_within_a_set_a_file_waits_for_the_others(tmp_path):
    path = tmp_path / "set" / "run.csv"
    with publishing(Destination(folder=path.parent), [path]) as results:
        write_text(results.at(path), "whole")
        assert results.at(path).read_text() == "whole"
        assert not path.exists()
    assert path.read_text() == "whole"

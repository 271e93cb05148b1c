"""Files are written whole or not at all, and never over others unasked."""

import pytest

from models.errors import OutputExists
from sim.files import refuse_existing, write_text, writing


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


def test_existing_files_are_named_before_any_work_unless_forced(tmp_path):
    there, missing = tmp_path / "there.csv", tmp_path / "missing.csv"
    there.write_text("mine")
    with pytest.raises(OutputExists, match=r"there\.csv exists.*--force"):
        refuse_existing([missing, there], force=False)
    refuse_existing([missing, there], force=True)
    refuse_existing([missing], force=False)
    with pytest.raises(OutputExists):
        write_text(there, "theirs")
    assert there.read_text() == "mine"

"""Which reader reads which file."""

import numpy as np
import pytest
from lab_files import write_csv, write_mat, write_parquet

from diagnosis.lab_files.readers import read as module
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.readers.read import read_lab_files
from models.errors import InvalidValue


def test_files_are_read_by_their_ending(tmp_path):
    paths = [write(tmp_path) for write in (write_csv, write_parquet, write_mat)]
    assert [len(file.tables[0].columns) for file in read_lab_files(paths)] == [6, 6, 6]


def test_a_text_file_of_any_ending_is_read(tmp_path):
    path = write_csv(tmp_path).rename(tmp_path / "run.DAT")
    assert read_lab_files([path])[0].tables[0].rows > 1000


@pytest.mark.parametrize(("name", "fix"), [("run.xlsx", "as CSV"), ("run.bag", "rosbags-convert")])
def test_a_known_format_that_is_not_read_says_what_to_do(tmp_path, name, fix):
    (tmp_path / name).write_bytes(b"x")
    with pytest.raises(InvalidValue, match=fix):
        read_lab_files([tmp_path / name])


def test_a_missing_file_and_two_of_one_name_are_refused(tmp_path):
    with pytest.raises(InvalidValue, match=r"gone\.csv"):
        read_lab_files([tmp_path / "gone.csv"])
    (tmp_path / "b").mkdir()
    with pytest.raises(InvalidValue, match="differ"):
        read_lab_files([write_csv(tmp_path), write_csv(tmp_path / "b")])


@pytest.mark.parametrize("values", [[1.0], [1.0, 2.0, 3.0]], ids=["a number", "a column"])
def test_a_name_that_nobody_can_read_names_its_file(values, tmp_path, monkeypatch):
    """As of a damaged MAT file: a mapping that names it could not be read again."""
    path = tmp_path / "run.mat"
    path.write_bytes(b"x")
    columns = {"tor\x00que": np.array(values)} if len(values) > 1 else {"time": np.arange(3.0)}
    scalars = {} if len(values) > 1 else {"tor\x00que": values[0]}
    damaged = LabFile(path=path, tables=(LabTable(title="run.mat", columns=columns),), scalars=scalars)
    monkeypatch.setitem(module._READERS, ".mat", lambda _: damaged)
    with pytest.raises(InvalidValue, match=r"run\.mat.*control characters"):
        read_lab_files([path])


def test_a_folder_is_answered_with_its_files(tmp_path):
    with pytest.raises(InvalidValue, match="list the files in it"):
        read_lab_files([tmp_path])

"""MAT files as numbers."""

import numpy as np
import pytest
from lab_files import LAB, MAT_NAMES, write_mat
from scipy.io import savemat

from diagnosis.lab_files.readers.mat_file import read_mat_file
from models.errors import InvalidValue


def test_a_struct_comes_back_as_it_was_written(tmp_path):
    file = read_mat_file(write_mat(tmp_path))
    (table,) = file.tables
    for name in LAB:
        np.testing.assert_array_equal(table.columns[f"run.{MAT_NAMES[name]}"], LAB[name])
    assert file.scalars == {"fs": 100.0}


def test_vectors_of_other_lengths_and_columns_of_a_matrix_are_tables_of_their_own(tmp_path):
    path = tmp_path / "run.mat"
    pose = np.arange(12.0).reshape(3, 4)  # three signals, four samples
    savemat(path, {"t": np.arange(9.0), "pose": pose, "note": "gel"})
    file = read_mat_file(path)
    by_rows = {table.rows: table.columns for table in file.tables}
    assert set(by_rows) == {9, 4}
    np.testing.assert_array_equal(by_rows[4]["pose[1]"], pose[1])
    assert any("'note'" in note for note in file.notes)


def test_version_7_3_is_refused_with_what_to_do(tmp_path):
    path = tmp_path / "run.mat"
    head = b"MATLAB 7.3 MAT-file".ljust(124, b" ") + bytes([0, 2]) + b"IM"
    path.write_bytes(head + b"\x89HDF\r\n\x1a\n" + bytes(512))
    with pytest.raises(InvalidValue, match=r"7\.3.*'-v7'"):
        read_mat_file(path)


def test_what_is_no_mat_file_is_refused_by_its_name(tmp_path):
    path = tmp_path / "run.mat"
    path.write_bytes(b"")
    with pytest.raises(InvalidValue, match=r"run\.mat"):
        read_mat_file(path)


@pytest.mark.parametrize(
    "broken", [b"MATLAB 5.0 MAT-file Platformposix", b"M" + bytes(200)], ids=["no version", "no type"]
)
def test_what_the_reader_stumbles_over_is_refused_by_its_name(broken, tmp_path):
    path = tmp_path / "run.mat"
    path.write_bytes(broken)
    with pytest.raises(InvalidValue, match=r"run\.mat.*readable MAT file"):
        read_mat_file(path)

"""Text files as numbers."""

import numpy as np
import pytest
from lab_files import LAB, write_csv

from diagnosis.lab_files.readers.text_file import read_text_file
from models.errors import InvalidValue


def read(tmp_path, content, encoding="utf-8"):
    path = tmp_path / "run.txt"
    path.write_bytes(content.encode(encoding))
    file = read_text_file(path)
    return file.tables[0].columns, file.notes


@pytest.mark.parametrize(("separator", "decimal"), [(";", ","), (",", "."), ("\t", ","), ("|", ".")])
def test_numbers_come_back_as_they_were_written(tmp_path, separator, decimal):
    path = write_csv(tmp_path, separator=separator, decimal=decimal)
    columns = read_text_file(path).tables[0].columns
    assert list(columns) == list(LAB)
    for name in LAB:
        np.testing.assert_allclose(columns[name], LAB[name], rtol=1e-11, atol=1e-15)  # 12 digits


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "cp1252"])
def test_a_degree_sign_survives_every_usual_encoding(tmp_path, encoding):
    columns, _ = read(tmp_path, "t;Winkel [°]\n0,0;1,5\n0,1;2,5\n", encoding)
    assert list(columns) == ["t", "Winkel [°]"]
    assert list(columns["Winkel [°]"]) == [1.5, 2.5]


def test_comments_between_rows_are_skipped_and_empty_cells_stay_empty(tmp_path):
    columns, notes = read(tmp_path, "t,x,y\n0,1,1\n# pause\n1,,2\n2,nan,3\n3,4,4\n")
    np.testing.assert_array_equal(columns["x"], [1, np.nan, np.nan, 4])
    assert notes == ()


def test_text_in_a_column_of_numbers_is_told_and_a_column_of_text_left_out(tmp_path):
    columns, notes = read(tmp_path, "t,x,state\n0,1,on\n1,ERR,on\n2,3,off\n3,4,off\n")
    np.testing.assert_array_equal(columns["x"], [1, np.nan, 3, 4])
    assert "state" not in columns
    assert any("'x'" in note and "'ERR' in row 2" in note for note in notes)
    assert any("'state'" in note for note in notes)


def test_times_of_a_calendar_become_seconds(tmp_path):
    columns, _ = read(tmp_path, "time,x\n2024-05-01 12:00:00.250,1\n2024-05-01 12:00:01.000,2\n")
    assert np.diff(columns["time"]) == pytest.approx(0.75, abs=1e-6)


def test_the_settings_of_the_recorder_are_kept(tmp_path):
    path = tmp_path / "run.csv"
    path.write_text("Interval,0.0005,Interval,0.0005\nChannel,Force,Channel,In\n0,1,0,2\n1,1,1,2\n")
    assert read_text_file(path).scalars == {"Interval": 0.0005}


def test_a_separator_behind_the_last_number_makes_no_column(tmp_path):
    columns, _ = read(tmp_path, "t;x;\n0,0;1,5;\n0,1;2,5;\n")
    assert [name for name in columns if name] == ["t", "x"]


@pytest.mark.parametrize("content", ["", "hello\nworld\n", "a;b\nc;d\n"])
def test_a_file_without_numbers_is_refused_by_its_name(tmp_path, content):
    with pytest.raises(InvalidValue, match=r"run\.txt.*two numbers"):
        read(tmp_path, content)


def test_a_binary_file_is_refused(tmp_path):
    path = tmp_path / "run.csv"
    path.write_bytes(b"\x89HDF\r\n\x1a\n\x00\x00\x00")
    with pytest.raises(InvalidValue, match="binary"):
        read_text_file(path)


def test_a_line_with_more_cells_than_the_others_is_named(tmp_path):
    with pytest.raises(InvalidValue, match="line 4"):
        read(tmp_path, "t;x\n0;1\n1;2\n2;3\n3;4;5;6\n4;5\n")

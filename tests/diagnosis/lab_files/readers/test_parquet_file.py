"""Parquet files as numbers."""

import numpy as np
import pandas as pd
import pytest
from lab_files import LAB, write_parquet

from diagnosis.lab_files.readers.parquet_file import read_parquet_file
from models.errors import InvalidValue


def test_numbers_come_back_as_they_were_written(tmp_path):
    columns = read_parquet_file(write_parquet(tmp_path)).tables[0].columns
    for name in LAB:
        np.testing.assert_array_equal(columns[name], LAB[name])


def test_times_become_seconds_and_text_is_left_out_with_a_note(tmp_path):
    at = pd.to_datetime(["2024-05-01 12:00:00.0", "2024-05-01 12:00:00.5"])
    table = pd.DataFrame({"at": at, "n": pd.array([1, None], "Int64"), "state": ["on", "off"]})
    file = read_parquet_file(write_parquet(tmp_path, table))
    columns = file.tables[0].columns
    assert np.diff(columns["at"]) == pytest.approx(0.5, abs=1e-6)
    np.testing.assert_array_equal(columns["n"], [1, np.nan])
    assert "'state'" in file.notes[0]


def test_what_is_no_parquet_is_refused_by_its_name(tmp_path):
    path = tmp_path / "run.parquet"
    path.write_text("no")
    with pytest.raises(InvalidValue, match=r"run\.parquet.*Parquet"):
        read_parquet_file(path)

"""Tables of a lab's file."""

from pathlib import Path

import numpy as np

from diagnosis.lab_files.readers.lab_table import LabFile, LabTable, unique_names


def test_a_name_that_returns_is_numbered():
    assert unique_names(["a", "b", "a", "a"]) == ["a", "b", "a #2", "a #3"]


def test_files_with_the_same_columns_are_of_one_kind():
    def file(name, *columns):
        table = LabTable(title=name, columns={c: np.zeros(3) for c in columns})
        return LabFile(path=Path(name), tables=(table,))

    assert file("a", "t", "x").header == file("b", "t", "x").header
    assert file("a", "t", "x").header != file("b", "t", "y").header

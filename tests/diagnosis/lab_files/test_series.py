"""Columns that are found in files, and those that are not."""

from pathlib import Path

import numpy as np
import pytest
from lab_files import KNOWN, LAB, mapping_of

from diagnosis.lab_files.mapping import ImportMapping
from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.series import NoTimes, raw_series, refuse_unreadable
from models.errors import InvalidValue


def file_of(name, columns):
    return LabFile(path=Path(name), tables=(LabTable(title=name, columns=columns),))


COLUMNS = {name: LAB[name].to_numpy() for name in LAB}


def test_values_stay_and_times_become_seconds_with_the_offset_of_their_clock():
    content = mapping_of(["run.csv"])
    content["columns"]["free_mm"]["time_offset_s"] = 0.25
    mapping = ImportMapping(**content)
    one = raw_series(mapping, mapping.trials[0], [file_of("run.csv", COLUMNS)], "free_mm")
    np.testing.assert_allclose(one.time_s, KNOWN["time_s"] + 0.25, atol=1e-9)
    np.testing.assert_array_equal(one.values, COLUMNS["free"])
    assert one.clock == ("run.csv", 0.25)


def test_a_column_that_two_files_have_needs_to_be_told_which():
    mapping = mapping_of(["a.csv", "b.csv"])
    mapping["trials"] = [{"file": "trial.csv", "lab_files": ["a.csv", "b.csv"]}]
    columns = {name: LAB[name].to_numpy() for name in LAB}
    files = [
        LabFile(path=Path(name), tables=(LabTable(title=name, columns=columns),))
        for name in ("a.csv", "b.csv")
    ]
    whole = ImportMapping(**mapping)
    with pytest.raises(InvalidValue, match="state 'file'"):
        raw_series(whole, whole.trials[0], files, "free_mm")
    mapping["columns"]["free_mm"]["file"] = 2
    whole = ImportMapping(**mapping)
    assert raw_series(whole, whole.trials[0], files, "free_mm").where.startswith("b.csv")


def test_all_columns_that_are_not_there_are_named_at_once():
    content = mapping_of(["run.csv"])
    content["columns"]["free_mm"]["column"] = "gone"
    content["columns"]["tip_angle_deg"]["column"] = "away"
    with pytest.raises(InvalidValue) as caught:
        refuse_unreadable(ImportMapping(**content), [file_of("run.csv", COLUMNS)])
    for name in ("columns.free_mm", "'gone'", "columns.tip_angle_deg", "'away'"):
        assert name in str(caught.value)
    assert "base_angle_deg" not in str(caught.value)


@pytest.mark.parametrize(("times", "found"), [([], "nothing"), (["gone", "away"], "'gone, away'")])
def test_without_times_it_is_said_what_to_write(times, found):
    stated = [{"column": name, "unit": "s"} for name in times]
    mapping = ImportMapping(**mapping_of(["run.csv"], times=stated))
    with pytest.raises(NoTimes, match=f"'sample_hz', found {found}; name the column"):
        raw_series(mapping, mapping.trials[0], [file_of("run.csv", COLUMNS)], "free_mm")


def test_a_file_that_was_not_given_is_named():
    mapping = ImportMapping(**mapping_of(["other.csv"]))
    with pytest.raises(InvalidValue, match=r"run\.csv.*other\.csv"):
        refuse_unreadable(mapping, [file_of("run.csv", COLUMNS)])


def test_what_is_there_is_not_refused():
    refuse_unreadable(ImportMapping(**mapping_of(["run.csv"])), [file_of("run.csv", COLUMNS)])

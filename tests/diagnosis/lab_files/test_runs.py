"""Several recordings in one file."""

from pathlib import Path

import numpy as np
import pytest

from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.runs import each_run

ROWS = 60


def file_of(name, runs, **more):
    columns = {"t": np.arange(runs.size, dtype=float), name: runs, **more}
    return LabFile(path=Path("all.csv"), tables=(LabTable(title="all.csv", columns=columns),))


@pytest.mark.parametrize("name", ["RUN", "trial [-]", "exp_1", "test no"])
def test_each_recording_is_a_file_of_its_own(name):
    one, other = each_run([file_of(name, np.repeat([1.0, 4.0], ROWS))])
    assert (one.path.name, other.path.name) == (f"all.csv#{name}=1", f"all.csv#{name}=4")
    assert (one.tables[0].rows, other.tables[0].rows) == (ROWS, ROWS)
    assert list(other.tables[0].columns) == ["t"]
    assert other.tables[0].columns["t"][0] == ROWS
    assert one.tables[0].title != other.tables[0].title


UNSPLIT = {
    "one recording": ("run", np.ones(ROWS)),
    "another quantity": ("motor", np.repeat([1.0, 2.0], ROWS)),
    "numbers that come back": ("run", np.repeat([1.0, 2.0, 1.0], ROWS)),
    "no whole numbers": ("run", np.repeat([1.0, 2.5], ROWS)),
    "a count of samples": ("test", np.arange(2.0 * ROWS)),
    "an empty cell": ("run", np.append(np.repeat([1.0, 2.0], ROWS), np.nan)),
}


@pytest.mark.parametrize("why", UNSPLIT)
def test_other_columns_split_nothing(why):
    file = file_of(*UNSPLIT[why])
    assert each_run([file]) == (file,)


def test_recordings_may_have_labels(tmp_path):
    """Each in one block; a state that comes and goes is left out, as before."""
    path = tmp_path / "all.csv"
    rows = [
        f"{i},{'AB'[i >= ROWS]},{'ok' if i % 2 else 'busy'},{i % 7},{i % 5},{i % 3}"
        for i in range(2 * ROWS)
    ]
    path.write_text("\n".join(["t,exp,state,x,y,z", *rows]))
    (file,) = read_lab_files([path])
    assert list(file.tables[0].columns) == ["t", "exp", "x", "y", "z"]
    assert any("2 labels (A, B): read as 1 to 2" in note for note in file.notes)
    assert [run.path.name for run in each_run([file])] == ["all.csv#exp=1", "all.csv#exp=2"]

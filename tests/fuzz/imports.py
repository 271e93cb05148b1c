"""Mappings and lab files that are nearly good, in every format."""

import tempfile
from pathlib import Path

import numpy as np
import pandas as pd
import yaml
from fuzz.mutations import changed_bytes, changed_lines, yaml_values
from fuzz.outcome import outcome
from hypothesis import strategies as st
from lab_files import (
    KNOWN,
    LAB,
    mapping_of,
    write_csv,
    write_json_mcap,
    write_mat,
    write_parquet,
    write_ros2,
)

from diagnosis.lab_files.draft_file import mapping_text
from diagnosis.lab_files.guesses.draft import drafted
from diagnosis.lab_files.read_mapping import read_mapping
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.write_log import imported
from models.plain_yaml import read_yaml

FEW = LAB.iloc[::12].reset_index(drop=True)


def _written(write, *arguments):
    with tempfile.TemporaryDirectory() as folder:
        return write(Path(folder), *arguments).read_bytes()


FILES = {
    "run.csv": _written(write_csv, FEW),
    "run.parquet": _written(write_parquet, FEW),
    "run.mat": _written(write_mat, FEW),
    "json.mcap": _written(write_json_mcap, FEW.iloc[:40]),
    "ros.mcap": _written(lambda folder: write_ros2(folder, KNOWN.iloc[:400:10])),
}
MAPPING = yaml.safe_dump(mapping_of(["run.csv"]), sort_keys=False)


texts = changed_lines(FILES["run.csv"].decode("utf-8-sig"), st.text(max_size=12)).map(
    lambda text: ("run.csv", text.encode("utf-8", "surrogatepass"))
)
lab_files = (
    st.sampled_from(list(FILES)).flatmap(
        lambda name: changed_bytes(FILES[name]).map(lambda data: (name, data))
    )
    | texts
)
renamed = st.tuples(st.sampled_from(list(FILES)), st.sampled_from(list(FILES))).map(
    lambda pair: (pair[0], FILES[pair[1]])
)
mappings = changed_lines(MAPPING, yaml_values).map(str.encode) | changed_bytes(MAPPING.encode())
same = st.sampled_from(
    [
        FILES["run.csv"],
        FILES["run.csv"].replace(b"\n", b"\r\n"),
        FILES["run.csv"].decode("utf-8-sig").encode("utf-16"),
        FILES["run.csv"].replace(b";", b" ; "),
        b"\n" + FILES["run.csv"].removeprefix(b"\xef\xbb\xbf"),
    ]
)


def checked_file(named):
    """Outcome of a lab file: read, drafted, and its draft read again."""
    name, data = named

    def action():
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            path = Path(folder, name)
            path.write_bytes(data)
            files = read_lab_files([path])
            draft = Path(folder, "mapping.yaml")
            draft.write_text(mapping_text(drafted(files)), encoding="utf-8")
            assert read_yaml(draft, expected="a mapping")["format"] == "rig-import/1"
        return [note for file in files for note in file.notes]

    return outcome(action, names=[name], same=False)


def checked_mapping(data, *, csv=FILES["run.csv"], same=False):
    """Outcome of a mapping, applied to a good file; or of a good one, applied to a file."""

    def action():
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            path, own = Path(folder, "mapping.yaml"), Path(folder, "run.csv")
            path.write_bytes(data)
            own.write_bytes(csv)
            trials = imported(read_mapping(path, accept_guesses=True), read_lab_files([own]))
        assert all(np.isfinite(trial.table["time_s"]).all() for trial in trials)
        if same:
            pd.testing.assert_frame_equal(trials[0].table, _right(), check_exact=True)
        return []

    return outcome(action, names=["mapping.yaml", "run.csv", "trial_00.csv"], same=same)


def _right():
    with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
        path, own = Path(folder, "mapping.yaml"), Path(folder, "run.csv")
        path.write_text(MAPPING)
        own.write_bytes(FILES["run.csv"])
        return imported(read_mapping(path, accept_guesses=True), read_lab_files([own]))[0].table

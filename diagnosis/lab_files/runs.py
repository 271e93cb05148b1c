"""Several recordings in one file, one after the other, which a column numbers: `run`, `trial`, `exp`.

Each of them is used like a file of its own, `all.csv#run=2`. The column has whole numbers, each in one
block of rows.
"""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np

from diagnosis.criteria.lab_files import MOST_RECORDINGS, RUN_LEAST_ROWS
from diagnosis.lab_files.readers.lab_table import Array, LabFile
from diagnosis.lab_files.units import without_unit
from diagnosis.log.unit_hints import words_of

_RUNS = {"run", "trial", "exp", "experiment", "test", "episode", "case", "rep", "repetition", "versuch"}


def each_run(files: Sequence[LabFile]) -> tuple[LabFile, ...]:
    """The files, each recording of one that has several as a file of its own."""
    return tuple(run for file in files for run in _runs_of(file))


def _runs_of(file: LabFile) -> tuple[LabFile, ...]:
    if len(file.tables) != 1:
        return (file,)
    for name, values in file.tables[0].columns.items():
        if _RUNS & set(words_of(without_unit(name))) and (blocks := _blocks(values)):
            return tuple(_run(file, name, rows) for rows in blocks)
    return (file,)


def _blocks(values: Array) -> list[slice]:
    """Rows of each number of a column, if each is in one block; else none."""
    if not np.isfinite(values).all() or np.any(values != np.round(values)):
        return []
    edges = np.concatenate(([0], np.flatnonzero(np.diff(values)) + 1, [values.size]))
    if not 2 <= edges.size - 1 <= MOST_RECORDINGS or np.diff(edges).min() < RUN_LEAST_ROWS:
        return []
    if np.unique(values).size < edges.size - 1:
        return []
    return [slice(first, end) for first, end in pairwise(edges.tolist())]


def _run(file: LabFile, name: str, rows: slice) -> LabFile:
    (table,) = file.tables
    title = f"{file.path.name}#{name}={table.columns[name][rows][0]:g}"
    columns = {other: values[rows] for other, values in table.columns.items() if other != name}
    own = replace(table, title=title, columns=columns)
    return replace(file, path=file.path.with_name(title), tables=(own,))

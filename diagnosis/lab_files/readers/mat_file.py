"""MAT files up to version 7: vectors, matrices and structs of them; one table for each length."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from scipy.io import loadmat

from diagnosis.lab_files.readers.lab_table import Array, LabFile, LabTable
from models.errors import InvalidValue

_MOST_COLUMNS = 64


def read_mat_file(path: Path) -> LabFile:
    """Read every vector, and every column of a matrix, under its name: `run.torque`, `pose[2]`.

    Raises:
      InvalidValue: names the file; one of version 7.3 says how to save it again.
    """
    try:
        content = loadmat(path, squeeze_me=True, struct_as_record=False)
    except NotImplementedError as error:
        again = "in MATLAB: load it, then save('NAME.mat', '-v7'); or write a CSV by writetable"
        raise InvalidValue(
            str(path), "version 7.3 (HDF5)", "a MAT file up to version 7", again
        ) from error
    except Exception as error:  # the reader raises all kinds on broken bytes
        reason = f"{type(error).__name__}: {str(error)[:200]}"
        raise InvalidValue(str(path), reason, "a readable MAT file") from error
    scalars: dict[str, float] = {}
    by_rows: dict[int, dict[str, Array]] = {}
    notes = []
    for name, value in _leaves({k: v for k, v in content.items() if not k.startswith("__")}):
        if value is None:
            notes.append(f"{path.name}: {name!r} is not a vector of numbers and is left out")
        elif value.size == 1:
            scalars[name] = float(value)
        else:
            by_rows.setdefault(value.size, {})[name] = np.where(np.isfinite(value), value, np.nan)
    if not by_rows:
        raise InvalidValue(str(path), sorted(content), "vectors of numbers, or structs of them")
    titles = {n: path.name if len(by_rows) == 1 else f"{path.name}, {n} rows" for n in by_rows}
    tables = [LabTable(title=titles[n], columns=columns) for n, columns in by_rows.items()]
    return LabFile(path=path, tables=tuple(tables), scalars=scalars, notes=tuple(notes))


def _leaves(value: Any, name: str = "") -> Iterator[tuple[str, Array | None]]:
    """Vectors by their path; None for anything else."""
    fields = value if isinstance(value, dict) else _fields(value)
    if fields is not None:
        for key, inner in fields.items():
            yield from _leaves(inner, f"{name}.{key}" if name else key)
        return
    array = np.asarray(value)
    if array.dtype.kind not in "fiub" or array.ndim > 2 or array.size == 0:
        yield name, None
    elif array.ndim < 2:
        yield name, array.astype(float)
    else:
        long = array if array.shape[0] >= array.shape[1] else array.T
        if long.shape[1] > _MOST_COLUMNS:
            yield name, None
            return
        for i, column in enumerate(long.T):
            yield f"{name}[{i}]", column.astype(float)


def _fields(value: Any) -> dict[str, Any] | None:
    names = getattr(value, "_fieldnames", None)
    return None if names is None else {name: getattr(value, name) for name in names}

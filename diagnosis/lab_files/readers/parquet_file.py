"""Parquet: a table with names and types; dates and times become seconds."""

from pathlib import Path

import numpy as np
import pandas as pd
import pyarrow

from diagnosis.lab_files.readers.lab_table import LabFile, LabTable
from models.errors import InvalidValue


def read_parquet_file(path: Path) -> LabFile:
    """Read the columns of numbers and times.

    Raises:
      InvalidValue: the file is not Parquet or has no numbers; names it.
    """
    try:
        table = pd.read_parquet(path)
    except (OSError, ValueError, pyarrow.ArrowException) as error:
        raise InvalidValue(str(path), str(error)[:200], "a readable Parquet file") from error
    if table.index.name is not None and table.index.name not in table:
        table = table.reset_index()
    columns, left_out = {}, []
    for name, column in table.items():
        if pd.api.types.is_datetime64_any_dtype(column):
            epoch = pd.Timestamp(0, tz=column.dt.tz)
            columns[str(name)] = np.asarray((column - epoch).dt.total_seconds(), float)
        elif pd.api.types.is_timedelta64_dtype(column):
            columns[str(name)] = np.asarray(column.dt.total_seconds(), float)
        elif pd.api.types.is_numeric_dtype(column):
            values = column.to_numpy(float, na_value=np.nan)
            columns[str(name)] = np.where(np.isfinite(values), values, np.nan)
        else:
            left_out.append(str(name))
    if not columns:
        raise InvalidValue(str(path), list(map(str, table.columns)), "columns of numbers")
    notes = tuple(f"{path.name}: {name!r} has no numbers and is left out" for name in left_out)
    return LabFile(path=path, tables=(LabTable(title=path.name, columns=columns),), notes=notes)

"""Chooses the reader of a file."""

from collections.abc import Callable, Sequence
from pathlib import Path

from diagnosis.lab_files.readers.lab_table import LabFile
from diagnosis.lab_files.readers.mat_file import read_mat_file
from diagnosis.lab_files.readers.mcap_file import read_mcap_file
from diagnosis.lab_files.readers.parquet_file import read_parquet_file
from diagnosis.lab_files.readers.text_file import read_text_file
from models.errors import InvalidValue
from models.names import is_file, is_folder
from models.user_text import unprintable

_READERS: dict[str, Callable[[Path], LabFile]] = {
    ".parquet": read_parquet_file,
    ".pq": read_parquet_file,
    ".mat": read_mat_file,
    ".mcap": read_mcap_file,
}
_OTHER = {
    ".xlsx": "save the sheet as CSV",
    ".xls": "save the sheet as CSV",
    ".bag": "convert it: rosbags-convert --src FILE.bag --dst FILE.mcap",
    ".db3": "convert it: ros2 bag convert, storage_id mcap",
    ".tdms": "export it as CSV",
    ".h5": "export its datasets as CSV or Parquet",
}


def read_lab_files(paths: Sequence[Path]) -> tuple[LabFile, ...]:
    """Read files, each according to its ending; as text if that is unknown.

    Raises:
      InvalidValue: names the first file that cannot be read, and how to fix it.
    """
    names = [path.name for path in paths]
    for path in paths:
        if not is_file(path):
            fix = "list the files in it" if is_folder(path) else ""
            raise InvalidValue("FILE", path, "the path of a file that exists", fix)
        if names.count(path.name) > 1:
            raise InvalidValue("FILE", path, "different file names", "rename one of the two")
        if path.suffix.lower() in _OTHER:
            raise InvalidValue(
                str(path),
                path.suffix,
                "CSV or other text, .parquet, .mat or .mcap",
                _OTHER[path.suffix.lower()],
            )
    files = tuple(_READERS.get(path.suffix.lower(), read_text_file)(path) for path in paths)
    for file in files:
        _refuse_unreadable_names(file)
    return files


def _refuse_unreadable_names(file: LabFile) -> None:
    """A mapping names columns and numbers, and nobody could read it."""
    columns = (name for table in file.tables for name in table.columns)
    for name in (*columns, *file.scalars):
        if unprintable(name):
            raise InvalidValue(
                str(file.path),
                name,
                "names of columns without control characters",
                "rename it, or save the file again: it may be damaged",
            )

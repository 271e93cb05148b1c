"""CSV and similar text files: any separator, decimal comma, comments, any names, usual encodings."""

import codecs
import io
import textwrap
from pathlib import Path

import numpy as np
import pandas as pd

from diagnosis.criteria.lab_files import MOST_RECORDINGS, RUN_LEAST_ROWS
from diagnosis.criteria.log import MOST_BYTES_PER_ROW, MOST_ROWS
from diagnosis.lab_files.readers.lab_table import Array, LabFile, LabTable
from diagnosis.lab_files.readers.text_cells import is_date, is_empty
from diagnosis.lab_files.readers.text_header import settings
from diagnosis.lab_files.readers.text_layout import TextLayout, text_layout
from models.errors import InvalidValue

_SHOWN = 40  # characters of labels
_EXPORT = "export the table as text with one line per sample and a header"


def read_text_file(path: Path) -> LabFile:
    """Read a text file of numbers.

    Raises:
      InvalidValue: names the file, and the line if one is at fault.
    """
    lines = _text(path).splitlines()
    layout = text_layout(lines)
    if layout is None:
        raise InvalidValue(
            str(path), _start(lines), "lines of at least two numbers, under a header with names", _EXPORT
        )
    notes = (
        [] if layout.named else [f"{path.name}: no header: columns are called column 1, column 2 ..."]
    )
    columns: dict[str, Array] = {}
    for name, column in _table(path, lines, layout).items():
        values, note = _numbers(column, layout.decimal)
        if note:
            notes.append(f"{path.name}: {name!r} {note}")
        if values is not None:
            columns[str(name)] = values
    table = LabTable(title=path.name, columns=columns)
    above = settings(lines[: layout.first_row], layout.separator, layout.decimal)
    return LabFile(path=path, tables=(table,), scalars=above, notes=tuple(notes))


def _text(path: Path) -> str:
    size = path.stat().st_size
    if size > MOST_ROWS * MOST_BYTES_PER_ROW:
        raise InvalidValue(str(path), f"{size} bytes", "a smaller file", "cut or decimate it")
    data = path.read_bytes()
    if data.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE)):
        return data.decode("utf-16")
    if b"\0" in data[:4096]:
        raise InvalidValue(str(path), "a binary file", "text, .parquet, .mat or .mcap", _EXPORT)
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError:
        return data.decode("cp1252", errors="replace")


def _table(path: Path, lines: list[str], layout: TextLayout) -> pd.DataFrame:
    """All cells as text, one row per line of numbers."""
    body = [line for line in lines[layout.first_row :] if not layout.is_comment(line)]
    # A separator behind the last cell of the numbers alone makes no column.
    try:
        return pd.read_csv(
            io.StringIO("\n".join(body)),
            sep=r"\s+" if layout.separator == " " else layout.separator,
            header=None,
            names=list(layout.names),
            dtype=str,
            keep_default_na=False,
            skipinitialspace=True,
            index_col=False,
        )
    except (pd.errors.ParserError, ValueError) as error:
        reason = str(error).strip()[-200:]
        expected = f"lines of {len(layout.names)} cells as in line {layout.first_row + 1}"
        raise InvalidValue(str(path), reason, expected, "correct or cut the line") from error


def _numbers(column: pd.Series, decimal: str) -> tuple[Array | None, str]:
    """Values of a column, NaN where empty, and a note on it; None: no numbers."""
    text = column.fillna("").str.strip().str.strip("\"'")
    empty = text.map(is_empty).to_numpy(bool)
    if empty.all():
        return None, "is empty and left out"
    first = text[~empty].iloc[0]
    if is_date(first):
        return _seconds(text), ""
    plain = text.str.replace(",", ".", regex=False) if decimal == "," else text
    values = pd.to_numeric(plain.str.replace(r"[dD]", "e", regex=True), errors="coerce").to_numpy(float)
    other = np.flatnonzero(~np.isfinite(values) & ~empty)
    values = np.where(np.isfinite(values), values, np.nan)
    if other.size == 0:
        return values, ""
    if 2 * other.size > (~empty).sum():
        if labels := _labels_of_blocks(text):
            return text.map(labels.index).to_numpy(float) + 1, _told_labels(labels)
        return None, f"holds text ({first[:20]!r}) and is left out"
    found = text.iloc[int(other[0])][:20]
    return values, f"holds text in {other.size} rows ({found!r} in row {other[0] + 1}): read as empty"


def _labels_of_blocks(text: pd.Series) -> list[str]:
    """Labels of a column, if each stands in one block of rows, as those of recordings do; else none."""
    labels = list(dict.fromkeys(text))
    lengths = text.groupby((text != text.shift()).cumsum()).size()
    each_once = 2 <= len(labels) == lengths.size <= MOST_RECORDINGS
    return labels if each_once and lengths.min() >= RUN_LEAST_ROWS else []


def _told_labels(labels: list[str]) -> str:
    shown = textwrap.shorten(", ".join(labels), _SHOWN, placeholder=" ...")
    return f"holds {len(labels)} labels ({shown}): read as 1 to {len(labels)}"


def _seconds(text: pd.Series) -> Array:
    """Times of day, or dates, as seconds since 1970, so that files of one clock stay aligned."""
    times = pd.to_datetime(
        text.str.replace(",", ".", regex=False), errors="coerce", format="mixed", utc=True
    )
    return np.asarray((times - pd.Timestamp(0, tz="UTC")).dt.total_seconds(), float)


def _start(lines: list[str]) -> str:
    return next((line[:60] for line in lines if line.strip()), "an empty file")

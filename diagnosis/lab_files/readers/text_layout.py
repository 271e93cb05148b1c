"""The layout of a text file of numbers: separator, decimal sign, header, first row of numbers.

Nothing has to be stated: of all combinations of separator and decimal sign, the one with the most
numeric and the fewest other cells is used. The header is the line above the numbers with
as many cells, marked as a comment or not; a line of units below it belongs to it.
"""

import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from diagnosis.lab_files.readers.lab_table import unique_names
from diagnosis.lab_files.units import is_unit

_SEPARATORS = (";", "\t", ",", "|", " ")
_COMMENTS = "#%!/*\"'"
_PROBED = 400
_NUMBER = {
    ".": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?"),
    ",": re.compile(r"[+-]?(\d+(,\d+)?|,\d+)([eE][+-]?\d+)?"),
}
_DATE = re.compile(r"(\d{4}-\d\d-\d\d[T ])?\d{1,2}:\d\d:\d\d([.,]\d+)?(Z|[+-]\d\d:?\d\d)?")
_EMPTY = {"", "nan", "na", "n/a", "-", "null", "none", "inf", "-inf", "+inf"}


@dataclass(frozen=True, kw_only=True)
class TextLayout:
    """Layout of a text file of numbers.

    Attributes:
      separator: between cells; a blank stands for any run of blanks.
      decimal: `.` or `,`.
      first_row: index of the first line of numbers.
      names: names of the columns.
      named: whether the file has a header.
    """

    separator: str
    decimal: str
    first_row: int
    names: tuple[str, ...]
    named: bool

    def is_comment(self, line: str) -> bool:
        """Whether a line between the numbers is a comment."""
        return not line.strip() or (line.lstrip()[0] in _COMMENTS and not _quoted(line))


def text_layout(lines: Sequence[str]) -> TextLayout | None:
    """The layout of a file; None if it has no two columns of numbers."""
    best: tuple[int, int, str, str] | None = None
    for separator in _SEPARATORS:
        for decimal in ".,":
            if separator == decimal:
                continue
            score, count = _score(lines, separator, decimal)
            if score > 0 and (best is None or score > best[0]):
                best = (score, count, separator, decimal)
    if best is None:
        return None
    _, count, separator, decimal = best
    first = next(
        i
        for i, line in enumerate(lines)
        if _is_row(row := cells(line, separator), decimal) and len(row) == count
    )
    names = _header([line for line in lines[:first] if line.strip()], separator, count)
    shown = names or [f"column {i + 1}" for i in range(count)]
    return TextLayout(
        separator=separator,
        decimal=decimal,
        first_row=first,
        names=tuple(unique_names(shown)),
        named=bool(names),
    )


def cells(line: str, separator: str) -> list[str]:
    """The cells of a line, without blanks and quotation marks around them."""
    parts = line.split() if separator == " " else line.split(separator)
    return [part.strip().strip("\"'").strip() for part in parts]


def is_empty(cell: str) -> bool:
    """Whether a cell is empty or a word for a missing number."""
    return cell.lower() in _EMPTY


def is_date(cell: str) -> bool:
    """Whether a cell is a time of day, with or without its date."""
    return _DATE.fullmatch(cell) is not None


def _score(lines: Sequence[str], separator: str, decimal: str) -> tuple[int, int]:
    """Numeric minus other cells in rows of the most frequent length, and that length."""
    rows = [row for line in lines[-_PROBED:] if _is_row(row := cells(line, separator), decimal)]
    if not rows:
        return 0, 0
    count = Counter(map(len, rows)).most_common(1)[0][0]
    inside = [cell for row in rows if len(row) == count for cell in row]
    known = sum(_is_known(cell, decimal) for cell in inside)
    empty = sum(is_empty(cell) for cell in inside)
    return known - (len(inside) - known - empty), count


def _is_row(row: Sequence[str], decimal: str) -> bool:
    """Whether most cells are numbers, times or empty."""
    known = sum(_is_known(cell, decimal) for cell in row)
    empty = sum(is_empty(cell) for cell in row)
    return len(row) > 1 and known > 0 and 2 * (known + empty) > len(row)


def _is_known(cell: str, decimal: str) -> bool:
    return _is_number(cell, decimal) or is_date(cell)


def _is_number(cell: str, decimal: str) -> bool:
    return _NUMBER[decimal].fullmatch(cell) is not None


def _header(above: Sequence[str], separator: str, count: int) -> list[str]:
    """Names from the lines above the numbers; empty if none has as many cells."""
    units: list[str] = []
    for line in reversed(above):
        row = _split(line, separator, count)
        if not any(row) or all(_is_number(cell, ".") for cell in row):
            continue
        if not units and all(not cell or cell == "-" or is_unit(cell.strip("[](){}<>")) for cell in row):
            units = row
            continue
        return [_with_unit(*pair) for pair in zip(row, units or [""] * count, strict=True)]
    return units


def _split(line: str, separator: str, count: int) -> list[str]:
    """A line of the header as so many cells, without a leading comment mark."""
    plain = line.strip() if separator != "\t" else line.strip("\r\n ")
    if plain[:1] in _COMMENTS and not _quoted(plain):
        plain = plain.lstrip(_COMMENTS).strip()
    for row in (cells(plain, separator), *(cells(plain, other) for other in _SEPARATORS)):
        if len(row) == count:
            return row
    wide = [part.strip() for part in re.split(r"\s{2,}|\t", plain)]
    return wide if len(wide) == count else []


def _with_unit(name: str, unit: str) -> str:
    unit = unit.strip("[](){}<>").strip()
    return f"{name} [{unit}]" if unit and unit != "-" else name


def _quoted(line: str) -> bool:
    return line.lstrip()[:1] in "\"'" and line.count(line.lstrip()[0]) > 1

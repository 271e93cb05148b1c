"""The layout of a text file of numbers: separator, decimal sign, header, first row of numbers.

Nothing has to be stated: of all combinations of separator and decimal sign, the one with the most
numeric and the fewest other cells is used.
"""

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from diagnosis.lab_files.readers.lab_table import unique_names
from diagnosis.lab_files.readers.text_cells import (
    SEPARATORS,
    cells,
    is_comment,
    is_date,
    is_empty,
    is_number,
)
from diagnosis.lab_files.readers.text_header import header_names

_PROBED = 400


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
        return not line.strip() or is_comment(line)


def text_layout(lines: Sequence[str]) -> TextLayout | None:
    """The layout of a file; None if it has no two columns of numbers."""
    best: tuple[int, int, str, str] | None = None
    for separator in SEPARATORS:
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
    names = header_names(lines[:first], separator, count)
    shown = [name or f"column {i + 1}" for i, name in enumerate(names or [""] * count)]
    return TextLayout(
        separator=separator,
        decimal=decimal,
        first_row=first,
        names=tuple(unique_names(shown)),
        named=bool(names),
    )


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
    return is_number(cell, decimal) or is_date(cell)

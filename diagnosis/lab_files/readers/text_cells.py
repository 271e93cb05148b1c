"""Cells of a line of text: numbers, times, empty cells and comment marks."""

import re

SEPARATORS = (";", "\t", ",", "|", " ")
COMMENTS = "#%!/*\"'"
_NUMBER = {
    ".": re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eEdD][+-]?\d+)?"),
    ",": re.compile(r"[+-]?(\d+(,\d+)?|,\d+)([eE][+-]?\d+)?"),
}
_DATE = re.compile(r"(\d{4}-\d\d-\d\d[T ])?\d{1,2}:\d\d:\d\d([.,]\d+)?(Z|[+-]\d\d:?\d\d)?")
_EMPTY = {"", "nan", "na", "n/a", "-", "null", "none", "inf", "-inf", "+inf"}


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


def is_number(cell: str, decimal: str) -> bool:
    """Whether a cell is a number with this decimal sign."""
    return _NUMBER[decimal].fullmatch(cell) is not None


def is_comment(line: str) -> bool:
    """Whether a line starts with a comment mark; a quoted cell is none."""
    return line.lstrip().startswith(tuple(COMMENTS)) and not _quoted(line)


def _quoted(line: str) -> bool:
    return line.lstrip()[:1] in "\"'" and line.count(line.lstrip()[0]) > 1

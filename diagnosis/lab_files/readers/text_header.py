"""The lines above the numbers of a text file: names, their units, and settings of the recorder.

The header is the line above the numbers with as many cells, marked as a comment or not. If that is a
line of units, the names are in the line above it. Some recorders mix both: a column whose cell is a unit
has its name above, the others have it in that cell.
"""

import re
from collections.abc import Sequence

from diagnosis.lab_files.readers.text_cells import COMMENTS, SEPARATORS, cells, is_comment, is_number
from diagnosis.lab_files.units import is_unit

_BRACKETS = "[](){}<>"
_TITLES = {"unit", "units", "einheit", "einheiten"}
_SETTING = re.compile(r"[^\W\d][\w .()\[\]/%-]*")


def header_names(above: Sequence[str], separator: str, count: int) -> list[str]:
    """Names of the columns; empty if no line has as many cells. A column without a name is an empty one.

    Args:
      above: lines above the numbers.
      count: cells of a line of numbers.
    """
    lines = [line for line in above if _is_header(_split(line, separator, count))]
    if not lines:
        return []
    lowest = _split(lines[-1], separator, count)
    if not (any(map(_is_unit, lowest)) or all(map(_in_brackets, lowest))) or len(lines) == 1:
        return lowest
    upper = _split(lines[-2], separator, count)
    if all(not cell or cell == "-" or _in_brackets(cell) or _is_unit(cell) for cell in lowest):
        return [_with_unit(*pair) for pair in zip(upper, lowest, strict=True)]
    if not _alike(lines[-2], lines[-1], separator, count):
        return lowest
    told = sum(map(_is_unit, lowest))
    if 2 * told > sum(map(bool, lowest)):
        return [_with_unit(*pair) for pair in zip(upper, lowest, strict=True)]
    return [
        _with_unit(name, cell) if _is_unit(cell) else cell
        for name, cell in zip(upper, lowest, strict=True)
    ]


def settings(above: Sequence[str], separator: str, decimal: str) -> dict[str, float]:
    """Single numbers above the numbers by their names: `Interval;0,0005` or `# rate = 100 Hz`."""
    found = {}
    for line in above:
        plain = line.strip().lstrip(COMMENTS).strip()
        for name, *values in (cells(plain, separator), re.split(r"\s*[:=]\s*", plain, maxsplit=1)):
            value = "".join(values[:1]).partition(" ")[0]
            if _SETTING.fullmatch(name) and is_number(value, decimal):
                found[name] = float(value.lower().replace(",", ".").replace("d", "e"))
                break
    return found


def _split(line: str, separator: str, count: int) -> list[str]:
    """A line of the header as so many cells, without a leading comment mark; empty if it has others."""
    plain = line.strip() if separator != "\t" else line.strip("\r\n ")
    if is_comment(plain):
        plain = plain.lstrip(COMMENTS).strip()
    for row in (cells(plain, separator), *(cells(plain, other) for other in SEPARATORS)):
        if len(row) == count:
            return row
    wide = [part.strip() for part in re.split(r"\s{2,}|\t", plain)]
    return wide if len(wide) == count else []


def _is_header(row: Sequence[str]) -> bool:
    return any(row) and not all(is_number(cell, ".") for cell in row)


def _is_unit(cell: str) -> bool:
    return cell.lower() in _TITLES or is_unit(cell.strip(_BRACKETS))


def _in_brackets(cell: str) -> bool:
    """Whether a cell is a unit in brackets, known or not: `[m/h]`, `[-]`."""
    return len(cell) > 2 and cell[0] in "[({<" and cell[-1] in "])}>"


def _alike(upper: str, lower: str, separator: str, count: int) -> bool:
    """Whether two lines of the header are written alike, so that one may go on in the other."""
    own = [len(cells(line, separator)) == count for line in (upper, lower)]
    row = _split(upper, separator, count)
    named = not any(is_number(cell, ".") or _is_unit(cell) for cell in row)
    return all(own) and named and is_comment(upper) == is_comment(lower)


def _with_unit(name: str, unit: str) -> str:
    """A name with its unit; without a name where the line above has only the title of its line."""
    if unit.lower() in _TITLES:
        return ""
    unit = unit.strip(_BRACKETS).strip()
    return f"{name} [{unit}]" if unit and unit != "-" else name

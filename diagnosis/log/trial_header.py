"""The names of a trial's columns, and what a file that begins otherwise may be."""

import csv
from collections.abc import Sequence
from pathlib import Path

from diagnosis.log.trial import COLUMNS, REQUIRED, UnusableLog
from diagnosis.log.unit_hints import look_alike

_CHUNK_BYTES = 1 << 20
_IMPORT = "or let `needle import` read the file as it is"
NO_TEXT = (
    "expected UTF-8 text, found a binary file or another encoding; export the table as CSV in UTF-8, "
    f"{_IMPORT}"
)


def _first_lines(path: Path) -> tuple[str, str]:
    with path.open(encoding="utf-8-sig") as file:
        first, second = file.readline(_CHUNK_BYTES), file.readline(_CHUNK_BYTES)
    if "\0" in first + second:
        raise UnusableLog(f"{path}: {NO_TEXT}")
    return first.strip(), second.strip()


def check_header(path: Path) -> None:
    """Check the names of the columns, and that the first row has as many cells.

    Raises:
      UnusableLog: names the file, the line or column, and how to fix it.
      OSError, UnicodeDecodeError: the file cannot be read, or is no UTF-8 text.
    """
    first, second = _first_lines(path)
    place = f"{path}, line 1"
    if not first:
        raise UnusableLog(
            f"{place}: expected the names of the columns, found an empty line or file; "
            "record the trial again, or take it out of rig.yaml"
        )
    header, cells = _cells(first), _cells(second)
    if first.startswith("#") or {*map(str.strip, cells)} >= {*REQUIRED}:
        raise UnusableLog(
            f"{place}: expected the names of the columns, found {first[:60]!r}; delete the lines above "
            "the names"
        )
    if "," not in first:
        raise UnusableLog(
            f"{place}: expected names with commas between, found {first[:60]!r}; "
            f"export with commas between the cells and decimal points in the numbers; {_IMPORT}"
        )
    _check_names(place, [name.strip() for name in header])
    if second and len(cells) != len(header):
        raise UnusableLog(
            f"{path}, line 2: expected {len(header)} cells as in the header, found {len(cells)}; "
            "write numbers with a decimal point, and no comma at the end of a line"
        )
    named = dict(zip((name.strip() for name in header), cells, strict=False))
    _refuse_units_or_dates(path, named.get("time_s", "").strip())


def _refuse_units_or_dates(path: Path, time: str) -> None:
    """Refuse a first row whose time is no number."""
    if not time or _is_number(time):
        return
    what = "dates; seconds are expected" if any(c.isdigit() for c in time) else "units: delete it"
    raise UnusableLog(
        f"{path}, line 2, column 'time_s': expected a number, found {time[:40]!r}, as in a row of "
        f"{what}; {_IMPORT}"
    )


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _cells(line: str) -> list[str]:
    return next(csv.reader([line], skipinitialspace=True), [])


def _check_names(place: str, names: Sequence[str]) -> None:
    double = [name for name in COLUMNS if names.count(name) > 1]
    if double:
        raise UnusableLog(f"{place}: column {double[0]!r} appears twice; rename or remove one")
    unknown = [name for name in names if name not in COLUMNS]
    for name in (name for name in COLUMNS if name not in names):
        alike = look_alike(unknown, name, COLUMNS)
        if alike:
            raise UnusableLog(
                f"{place}: column {name!r} is missing; {alike.found!r} looks like it: {alike.fix}, "
                "or give it another name if it is something else"
            )
        if name in REQUIRED:
            raise UnusableLog(
                f"{place}: column {name!r} is missing; expected {', '.join(REQUIRED)} "
                f"and what was measured; the file has {', '.join(names)[:300]}; add or rename it"
            )

"""Tables on a screen of any width: nothing is cut; a table that is too wide becomes several.

    name   a   b   c          name   a   b
    ────────────────    ->    ────────────    then the same names beside c
    one    1   2   3          one    1   2

Cells wrap between words, the widest column first; inside a word only if it is longer than half
the screen.
"""

from collections.abc import Sequence
from dataclasses import replace

from rich.box import SIMPLE_HEAD
from rich.console import Console
from rich.measure import Measurement
from rich.table import Column, Table


def print_table(console: Console, table: Table, *, keys: int = 1) -> None:
    """Print a table no wider than the screen.

    Args:
      keys: number of columns that name a row; they are repeated in every part of the table.
    """
    for part in fitted(console, table, keys=keys):
        console.print(part)


def fitted(console: Console, table: Table, *, keys: int = 1) -> list[Table]:
    """The table as it is, if it fits; else with narrow rules; else as several tables."""
    for whole in (table, _dense(table)):
        if _fits(console, whole, whole.columns):
            return [_with_columns(console, whole, whole.columns)]
    parts = [_with_columns(console, whole, part) for part in _column_parts(console, whole, keys)]
    for later in parts[1:]:
        later.title = f"{table.title}, continued" if table.title else None
    for earlier in parts[:-1]:
        earlier.caption = None
    return parts


def _column_parts(console: Console, table: Table, keys: int) -> list[list[Column]]:
    """Groups of as many columns as fit beside the keys."""
    key, parts = table.columns[:keys], [table.columns[:keys]]
    for column in table.columns[keys:]:
        if len(parts[-1]) > keys and not _fits(console, table, [*parts[-1], column]):
            parts.append(list(key))
        parts[-1] = [*parts[-1], column]
    return parts


def _fits(console: Console, table: Table, columns: Sequence[Column]) -> bool:
    """Whether no cell has to wrap inside a word."""
    least = [_span(console, column, heading=table.show_header).minimum for column in columns]
    return sum(least) + _rules(table, columns) <= console.width


def _widths(console: Console, table: Table, columns: Sequence[Column]) -> list[int]:
    """Widths of columns: the widest shrinks until all fit, or down to its longest word."""
    spans = [_span(console, column, heading=table.show_header) for column in columns]
    widths, least = [span.maximum for span in spans], [span.minimum for span in spans]
    room = max(console.width - _rules(table, columns), len(columns))
    while sum(widths) > room:
        # Where nothing is left to break between words, the widest names are folded, not the numbers.
        able = [i for i, width in enumerate(widths) if width > least[i]] or range(len(widths))
        widths[max(able, key=lambda i: widths[i])] -= 1
    return widths


def _span(console: Console, column: Column, *, heading: bool) -> Measurement:
    """Longest word and longest line of a column."""
    wide = console.options.update(width=10_000)
    cells = [*([column.header] if heading else []), *column.cells]
    each = [Measurement.get(console, wide, cell) for cell in cells]
    longest = max((m.maximum for m in each), default=1)
    whole = min(longest, column.max_width or longest)
    word = whole if column.no_wrap else max((m.minimum for m in each), default=1)
    least = min(word, console.width // 2)
    return Measurement(least, max(whole, least))


def _rules(table: Table, columns: Sequence[Column]) -> int:
    """Width of everything beside the cells."""
    edges = 2 if table.box and table.show_edge else 0
    _, right, _, left = table.padding
    padding = (left + right) * len(columns)
    return edges + padding + (len(columns) - 1 if table.box else 0)


def _dense(table: Table) -> Table:
    made = _like(table, table.columns)
    made.box, made.padding = SIMPLE_HEAD, (0, 1, 0, 0)
    return made


def _with_columns(console: Console, table: Table, columns: Sequence[Column]) -> Table:
    made = _like(table, columns)
    for column, width in zip(made.columns, _widths(console, table, columns), strict=True):
        column.width, column.no_wrap = width, False
    return made


def _like(table: Table, columns: Sequence[Column]) -> Table:
    """The same rows with some of the columns."""
    made = Table(
        *(replace(column, _cells=[], overflow="fold") for column in columns),
        title=table.title,
        caption=table.caption,
        box=table.box,
        show_header=table.show_header,
    )
    made.padding = table.padding
    rows = zip(*(column.cells for column in columns), strict=True)
    for cells, row in zip(rows, table.rows, strict=True):
        made.add_row(*cells, end_section=row.end_section)
    return made

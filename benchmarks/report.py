"""Common parts of the benchmarks: timing, tables, goals, output files.

Times are CPU times of the process. The load and the clock rate of a machine vary:
tasks that are compared alternate in one run, and the shortest time of each counts.
"""

import argparse
import math
import time
from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

import matplotlib as mpl
import matplotlib.pyplot as plt
import pandas as pd
from matplotlib.figure import Figure
from rich.console import Console
from rich.table import Table as RichTable

mpl.use("Agg")

Key = TypeVar("Key", bound=Hashable)

_CONSOLE = Console(width=120, highlight=False)
_FILES_ALONE: ContextVar[bool] = ContextVar("files_alone", default=False)


@dataclass(frozen=True, kw_only=True)
class Goal:
    """A measured value and its bound; NaN: not measured here, or no bound.

    Attributes:
      accuracy: the accuracy at which it was measured.
    """

    name: str
    measured: float
    bound: float = math.nan
    at_least: bool = False
    unit: str = "-"
    accuracy: str = "-"

    @property
    def asked(self) -> str:
        """The bound in words."""
        if math.isnan(self.bound):
            return "-"
        return f"{'>=' if self.at_least else '<='} {self.bound:g}"

    @property
    def met(self) -> str:
        """Whether the goal is met, in words."""
        if math.isnan(self.measured):
            return "not measured"
        if math.isnan(self.bound):
            return "-"
        kept = self.measured >= self.bound if self.at_least else self.measured <= self.bound
        return "yes" if kept else "NO"


def least_times_s(
    tasks: Mapping[Key, Callable[[], object]], *, turns: int, enough_s: float = 0.3
) -> dict[Key, float]:
    """Least CPU time of each task, s; the tasks take turns.

    Args:
      tasks: by name; each runs once before it is timed.
      turns: largest number of runs of each.
      enough_s: a task that has used this much time is not repeated.
    """
    for task in tasks.values():
        task()
    least = dict.fromkeys(tasks, math.inf)
    spent = dict.fromkeys(tasks, 0.0)
    for _ in range(turns):
        for key, task in tasks.items():
            if spent[key] > enough_s:
                continue
            start = time.process_time()
            task()
            taken = time.process_time() - start
            least[key] = min(least[key], taken)
            spent[key] += taken
    return least


def show(title: str, rows: Sequence[Mapping[str, Any]], folder: Path, name: str) -> None:
    """Write rows of one shape as `name`.csv, and print them as a table, unless in `files_alone`."""
    if not _FILES_ALONE.get():
        _print(title, rows)
    write_csv(rows, folder, name)


@contextmanager
def files_alone() -> Iterator[None]:
    """Tables are written and not printed while the block runs."""
    before = _FILES_ALONE.set(True)
    try:
        yield
    finally:
        _FILES_ALONE.reset(before)


def _print(title: str, rows: Sequence[Mapping[str, Any]]) -> None:
    table = RichTable(title=title, title_justify="left")
    for column in rows[0]:
        numeric = not isinstance(rows[0][column], str)
        table.add_column(column, justify="right" if numeric else "left")
    for row in rows:
        table.add_row(*(_cell(value) for value in row.values()))
    _CONSOLE.print(table)


def write_csv(rows: Sequence[Mapping[str, Any]], folder: Path, name: str) -> None:
    """Write rows of one shape as `name`.csv."""
    folder.mkdir(parents=True, exist_ok=True)
    pd.DataFrame(rows).to_csv(folder / f"{name}.csv", index=False)


def _cell(value: Any) -> str:
    if isinstance(value, float):
        return "-" if math.isnan(value) else f"{value:.3g}" if abs(value) < 1e3 else f"{value:,.0f}"
    return str(value)


def show_goals(goals: Sequence[Goal], folder: Path) -> None:
    """The one table: what, measured, at which accuracy, and whether a goal is met."""
    rows = [
        {
            "what": goal.name,
            "measured": goal.measured,
            "unit": goal.unit,
            "accuracy": goal.accuracy,
            "goal": goal.asked,
            "met": goal.met,
        }
        for goal in goals
    ]
    _print("Each measured in one run; ratios are over ours, or as named", rows)
    write_csv(rows, folder, "goals")


def say(text: str) -> None:
    """A line between tables."""
    _CONSOLE.print(text)


def save(figure: Figure, folder: Path, name: str) -> None:
    """Write a figure as `name`.png."""
    folder.mkdir(parents=True, exist_ok=True)
    figure.savefig(folder / f"{name}.png", dpi=130)
    plt.close(figure)


def out_folder(parser: argparse.ArgumentParser) -> Path:
    """The folder that the command line names."""
    return Path(parser.parse_args().out)


def parser(description: str | None) -> argparse.ArgumentParser:
    """A command line with `--out`."""
    made = argparse.ArgumentParser(description=(description or "").splitlines()[0])
    made.add_argument("--out", default="out/bench", help="folder for CSV and PNG")
    return made

"""Prints which results a command wrote, and returns its exit code."""

from collections.abc import Iterable
from pathlib import Path

from rich.console import Console

from scripts.exit_codes import ExitCode
from scripts.streams import complain
from sim.files import ResultSet


def tell(results: ResultSet, console: Console, *, shown: Iterable[Path | str] | None = None) -> ExitCode:
    """Print the path of every file that exists on a line of its own; missing ones on standard error.

    Args:
      shown: lines to print instead of the paths; None: the paths.
    """
    for path in results.made if shown is None else shown:
        console.print(f"wrote      {path}", highlight=False, markup=False, soft_wrap=True)
    for path, why in results.left_out.items():
        complain(f"warning: {path} could not be made ({why}); the other results are complete")
    for path, parts in results.lacks.items():
        for part in parts:
            complain(f"warning: {path} lacks {part}; the rest of it is complete")
    all_there = not results.left_out and not any(results.lacks.values())
    return ExitCode.DONE if all_there else ExitCode.WITHOUT_ALL

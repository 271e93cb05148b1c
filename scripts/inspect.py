"""`needle inspect`: open a recording in rerun's viewer, or list its content."""

import os
import subprocess
import sys
from pathlib import Path

from rich.console import Console
from rich.table import Table

from scripts.tables import print_table
from sim.files import finish_interrupted
from sim.recording.rerun_table import Entry, entries


def run(path: Path, *, table: bool, console: Console) -> int:
    """Open or list; the viewer listens on the loopback address only."""
    finish_interrupted(path.parent)
    found = entries(path)
    if table:
        print_table(console, as_table(path, found))
        return 0
    environment = os.environ | {"CI": "1"}  # the viewer then collects nothing
    viewer = [sys.executable, "-m", "rerun", "--bind", "127.0.0.1", str(path)]
    code = subprocess.call(viewer, env=environment)
    if code != 0:
        console.print("the viewer did not open; without a screen, --table lists the content")
    return code


def as_table(path: Path, found: list[Entry]) -> Table:
    """A table with one row per component."""
    shown = Table(title=str(path))
    shown.add_column("entity")
    for heading in ("rows", "from, s", "to, s", "last value"):
        shown.add_column(heading, justify="right", no_wrap=True)
    shown.add_column("unit", no_wrap=True)
    shown.add_column("component")
    for e in found:
        times = ["" if t is None else f"{t:.2f}" for t in (e.start_s, e.end_s)]
        last = "" if e.last is None else f"{e.last:.4g}"
        shown.add_row(e.entity, str(e.rows), *times, last, e.unit, e.component)
    return shown

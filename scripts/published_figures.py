"""`needle diagnose --paper`: what the published figures say of the published rig's gap."""

import json
from collections.abc import Sequence
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from sim.files import refuse_existing
from studies.published.report.json_report import as_json, output_paths, write_report
from studies.published.report.sentences import limits, next_experiment, sentence
from studies.published.report.tables import (
    candidate_rows,
    compensator_rows,
    figure_rows,
    prospect_rows,
    word_rows,
)
from studies.published.study import Case, run_study

_WITHOUT_VALUES = (0, 1, 3, 4, 5, 6, 8)  # columns: candidate, reading, gap, left out, p, AICc, cannot


def run(folder: Path | None, *, json_only: bool, force: bool, console: Console) -> int:
    """Diagnose Tables II, IV and V; prints a summary, or `paper.json`.

    Args:
      folder: where `paper.json` and `paper.html` go; None: nowhere.

    Raises:
      OutputExists: a result exists and `force` is not given; before any work.
    """
    if folder:
        refuse_existing(output_paths(folder), force=force)
    shown = Console(stderr=True)
    with Progress(TextColumn("{task.description}"), BarColumn(), console=shown, transient=True) as bar:
        task = bar.add_task("the published figures", total=1.0)
        study = run_study(lambda what, share: bar.update(task, description=what, completed=share))
    paths = write_report(study, folder, force=force) if folder else []
    if json_only:
        console.print_json(json.dumps(as_json(study), allow_nan=False))
        return 0
    for case in (study.plastisol, study.gelatin):
        _show(case, console)
    console.print(_table(prospect_rows(study), "What would tell the explanations apart"))
    console.print(_table(compensator_rows(study), "The compensator's columns, with gains of our own"))
    for line in (*limits(study), *filter(None, [next_experiment(study)])):
        console.print(f"- {line}", highlight=False)
    for warning in study.warnings:
        console.print(f"warning: {warning}", highlight=False)
    for path in paths:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def _show(case: Case, console: Console) -> None:
    rows = candidate_rows(case)
    accepted = [row for row in rows if row[0].endswith("*")]
    console.print(f"\n[bold]{sentence(case)}[/]", highlight=False)
    console.print(_table(figure_rows(case), "Published, ours, ratio"))
    short = [[row[i] for i in _WITHOUT_VALUES] for row in rows]
    console.print(_table(short, "What could close the gap (*: accepted)"))
    if accepted:
        console.print(_table([row[:3] for row in (rows[0], *accepted)], "Fitted values"))
    console.print(_table(word_rows(case), "What the text says beyond the tables"))


def _table(rows: Sequence[Sequence[str]], title: str) -> Table:
    table = Table(title=title)
    for name in rows[0]:
        table.add_column(name, overflow="fold")
    for row in rows[1:]:
        table.add_row(*row)
    return table

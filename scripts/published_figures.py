"""`needle diagnose --paper`: what explains the published figures where the stated model fails."""

import json
from pathlib import Path

from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table
from rich.text import Text

from scripts.results import tell
from scripts.terminal import terminal
from sim.files import Destination
from studies.published.material_study import MaterialStudy
from studies.published.report.contents import as_json
from studies.published.report.files import output_paths, write_report
from studies.published.report.insertion_tables import insertion_sentences, insertion_table
from studies.published.report.limitations import limitations
from studies.published.report.sentences import next_experiment, verdict_sentence
from studies.published.report.tables import (
    TextTable,
    accepted_table,
    compensator_table,
    figure_table,
    mechanism_table,
    proposed_table,
    text_ranking_table,
    text_table,
)
from studies.published.study import PublishedStudy, run_published_study


def run(folder: Path | None, *, json_only: bool, force: bool, console: Console) -> int:
    """Diagnose Tables II, IV and V, and Figs. 3, 5, 11 and 12; prints a summary, or `paper.json`.

    Args:
      folder: where `paper.json` and `paper.html` go; None: nowhere.

    Raises:
      OutputExists: a result exists and `force` is not given; before any work.
    """
    destination = Destination(folder=folder, force=force) if folder else None
    if destination:
        destination.check(output_paths(destination.folder))
    study = _run_with_progress()
    written = write_report(study, destination) if destination else None
    if json_only:
        console.print_json(json.dumps(as_json(study), allow_nan=False))
    else:
        _show(study, console)
    return tell(written, Console(quiet=True) if json_only else console) if written else 0


def _run_with_progress() -> PublishedStudy:
    shown = terminal(stderr=True)
    with Progress(TextColumn("{task.description}"), BarColumn(), console=shown, transient=True) as bar:
        task = bar.add_task("the published figures", total=1.0)
        return run_published_study(
            lambda what, share: bar.update(task, description=what, completed=share)
        )


def _show(study: PublishedStudy, console: Console) -> None:
    for material in (study.plastisol, study.gelatin):
        _show_material(material, console)
    nearest = text_ranking_table(study.plastisol)
    console.print(_table(nearest, "Fits to the tables that come nearest to the figures in the text"))
    title = "Steered insertions, half turns to and fro (*: both deviations within 2 σ)"
    console.print(_table(insertion_table(study.insertions), title))
    for line in insertion_sentences(study.insertions):
        console.print(f"- {line}", highlight=False)
    console.print(_table(proposed_table(study), "Experiments that would separate the explanations"))
    title = "Turns with the torsion compensator (simulated: gains and motor are our own)"
    console.print(_table(compensator_table(study), title))
    for line in (*limitations(study), *filter(None, [next_experiment(study)])):
        console.print(f"- {line}", highlight=False)
    for warning in study.warnings:
        console.print(f"warning: {warning}", highlight=False)


def _show_material(study: MaterialStudy, console: Console) -> None:
    console.print(Text(f"\n{verdict_sentence(study)}", "bold"))
    console.print(_table(figure_table(study), "Stated model and published figures"))
    mechanisms = mechanism_table(study, with_values=False)
    console.print(_table(mechanisms, "Mechanisms that may explain the residual (*: accepted)"))
    accepted = accepted_table(study)
    if accepted.rows:
        console.print(_table(accepted, "Fitted values"))
    console.print(_table(text_table(study), "Figures in the paper's text"))


def _table(content: TextTable, title: str) -> Table:
    table = Table(title=title)
    for name in content.head:
        table.add_column(name, overflow="fold")
    for row in content.rows:
        table.add_row(*row)
    return table

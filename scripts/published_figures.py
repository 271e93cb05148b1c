"""`needle diagnose --paper`: what explains the published figures that the stated model misses."""

import json
from pathlib import Path

from rich.console import Console
from rich.table import Table
from rich.text import Text

from scripts.exit_codes import ExitCode
from scripts.output_folder import output_folder
from scripts.progress_line import stage_line
from scripts.results import tell
from scripts.tables import print_table
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

DEFAULT = Path("out/paper")


def run(out: Path | None, *, json_only: bool, force: bool, console: Console) -> int:
    """Diagnose Tables II, IV and V, and Figs. 3, 5, 11 and 12; prints a summary, or `paper.json`.

    Args:
      out: folder of `paper.json` and `paper.html`; None: a default folder, or none with `json_only`.

    Raises:
      OutputExists: a result exists and `force` is not given; checked before any work.
    """
    writes = out is not None or not json_only
    destination = output_folder(out, DEFAULT, output_paths, force=force) if writes else None
    with stage_line() as stage:
        study = run_published_study(stage)
        written = write_report(study, destination) if destination else None
    if json_only:
        console.print_json(json.dumps(as_json(study), allow_nan=False))
    else:
        _show(study, console)
    return tell(written, console, shown=() if json_only else None) if written else ExitCode.DONE


def _show(study: PublishedStudy, console: Console) -> None:
    for warning in study.warnings:
        console.print(f"warning: {warning}", highlight=False)
    for material in (study.plastisol, study.gelatin):
        _show_material(material, console)
    nearest = text_ranking_table(study.plastisol)
    _print(console, nearest, "Fits to the tables that come nearest to the figures in the text")
    title = "Steered insertions, half turns to and fro (*: both deviations within 2 σ)"
    _print(console, insertion_table(study.insertions), title)
    for line in insertion_sentences(study.insertions):
        console.print(f"- {line}", highlight=False)
    _print(console, proposed_table(study), "Experiments that would separate the explanations")
    title = "Turns with the torsion compensator (simulated: gains and motor are our own)"
    _print(console, compensator_table(study), title)
    for line in (*limitations(study), *filter(None, [next_experiment(study)])):
        console.print(f"- {line}", highlight=False)


def _show_material(study: MaterialStudy, console: Console) -> None:
    console.print(Text(f"\n{verdict_sentence(study)}", "bold"))
    _print(console, figure_table(study), "Stated model and published figures")
    mechanisms = mechanism_table(study, with_values=False)
    _print(console, mechanisms, "Mechanisms that may explain the residual (*: accepted)")
    accepted = accepted_table(study)
    if accepted.rows:
        _print(console, accepted, "Fitted values")
    _print(console, text_table(study), "Figures in the paper's text")


def _print(console: Console, content: TextTable, title: str) -> None:
    table = Table(title=title)
    for name in content.head:
        table.add_column(name, overflow="fold")
    for row in content.rows:
        table.add_row(*row)
    print_table(console, table)

"""`needle diagnose`: what a rig has that its nominal model lacks."""

import json
from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.progress import BarColumn, Progress, TextColumn
from rich.table import Table

from diagnosis.diagnose import Diagnosis, diagnose
from diagnosis.limits import cannot_tell
from diagnosis.page import sentence
from diagnosis.page_tables import strength
from diagnosis.report import as_json, output_paths, write_report
from diagnosis.rig_log import read_rig_log
from sim.files import refuse_existing

_SHOWN = 0.0005  # what rounds to more than 0.000


def run(log_folder: Path, folder: Path | None, *, json_only: bool, force: bool, console: Console) -> int:
    """Diagnose a log; prints a summary, or `report.json`."""
    log = read_rig_log(log_folder)
    if folder:
        refuse_existing(output_paths(log, folder), force=force)
    shown = Console(stderr=True)
    with Progress(TextColumn("{task.description}"), BarColumn(), console=shown, transient=True) as bar:
        task = bar.add_task("replaying", total=1.0)
        found = diagnose(
            log, progress=lambda what, share: bar.update(task, description=what, completed=share)
        )
    paths = write_report(found, folder, force=force) if folder else []
    if json_only:
        console.print_json(json.dumps(as_json(found)))
        return 0
    console.print(f"[bold]{sentence(found)}[/]", highlight=False)
    console.print(_gap_table(found))
    if found.verdict.effects:
        console.print(_parameter_table(found))
    console.print(_ranking_table(found))
    if found.hidden and not found.verdict.effects:
        console.print(_hidden_table(found))
    if found.next_experiment:
        console.print(f"next: {escape(found.next_experiment)}", highlight=False)
    for limit in cannot_tell(log):
        console.print(f"open: {escape(limit)}", highlight=False)
    for warning in found.warnings:
        console.print(f"warning: {escape(warning)}", highlight=False)
    for path in paths:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def _gap_table(found: Diagnosis) -> Table:
    table = Table("where the gap lives", "noise units", title="Gap to the nominal model")
    where = found.where
    for name, value in (*where.signal.items(), *where.phase.items()):
        table.add_row(name, f"{value:.2f}")
    for low, high, value in where.band_hz:
        table.add_row(f"{low:g} to {high:g} Hz", f"{value:.2f}")
    for depth, value in where.depth_mm:
        table.add_row(f"{depth:g} mm deep", f"{value:.2f}")
    stretch, value = where.worst
    table.add_row(stretch, f"{value:.2f}")
    return table


def _parameter_table(found: Diagnosis) -> Table:
    table = Table("effect", "parameter", "value", "95 % interval", "unit", title="What explains it")
    for effect, values in as_json(found)["parameters"].items():
        for name, p in values.items():
            interval = f"{p['low']:.4g} .. {p['high']:.4g}"
            table.add_row(effect, name, f"{p['value']:.4g}", interval, p["unit"])
    return table


def _hidden_table(found: Diagnosis) -> Table:
    table = Table("effect", "may be there", title="What could be there unseen")
    for effect, values in found.hidden.items():
        table.add_row(effect, strength(effect, values))
    return table


def _ranking_table(found: Diagnosis) -> Table:
    table = Table("explanation", "probability", title="Ranking")
    for name, probability in found.verdict.ranking[:5]:
        if probability >= _SHOWN:
            table.add_row(name, f"{probability:.3f}")
    return table

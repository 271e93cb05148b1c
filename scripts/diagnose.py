"""`needle diagnose`: what a rig has that its nominal model lacks."""

import json
import time
from collections.abc import Iterator, Mapping
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.markup import escape
from rich.table import Table

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.log.rig_log import read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from diagnosis.report.sensors import imperfections
from diagnosis.report.sentences import alike, headline, largest_parts, largest_residual, nearest
from diagnosis.report.tables import limit_in_words
from diagnosis.report.write import output_paths, write_report
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.result import Diagnosis
from diagnosis.stopping import StoppedEarly, StopSignal
from scripts.output_folder import output_folder, say_written
from scripts.progress_line import progress_line
from scripts.stop_signals import EXIT_CODES, stops_on_signals
from scripts.tables import print_table
from sim.simulation import prepare_processes

DEFAULT = Path("out/diagnose")
_SHOWN = 0.0005  # what rounds to more than 0.000
_REPORT_LEAST_S = 3.0  # kept of a limit for the report
_REPORT_STARTS = 1.5  # times what Python took to start: on a busy machine both are slow


def run(
    log_folder: Path,
    out: Path | None,
    *,
    json_only: bool,
    force: bool,
    console: Console,
    limit_s: float | None = None,
    began_s: float | None = None,
) -> int:
    """Diagnose a log; prints a summary, or `report.json`.

    Args:
      out: where the report goes; None: a default folder, or nowhere with `json_only`.
      limit_s: for all of it; None: no limit.
      began_s: `time.monotonic()` from which the limit counts; None: now.

    Returns:
      0, or 128 and the number of the signal that asked for the best so far.
    """
    used_s = time.monotonic() - began_s if began_s else 0.0
    writes = out is not None or not json_only
    reserve_s = max(_REPORT_LEAST_S, _REPORT_STARTS * used_s) if writes else 0.0
    stop = StopSignal(limit_s, began_s=began_s, reserve_s=reserve_s)
    log = read_rig_log(log_folder)
    outputs = partial(output_paths, log)
    folder = output_folder(out, DEFAULT, outputs, force=force) if writes else None
    shown = Console(stderr=True)
    for warning in log.warnings:
        shown.print(f"warning: {escape(warning)}", highlight=False)
    prepare_processes()  # compiles for half a minute the first time, before there is anything to tell
    with stops_on_signals(stop):
        try:
            with progress_line(shown, stop) as show:
                found = diagnose(log, stop=stop, progress=show)
        except StoppedEarly as early:
            if not stop.requested:
                raise
            shown.print(f"needle diagnose: {early}")
            return EXIT_CODES[stop.requested]
        paths = write_report(found, folder, force=force) if folder else []
        if json_only:
            console.print_json(json.dumps(as_json(found)))
        else:
            _summary(found, console)
            say_written(console, paths)
    return EXIT_CODES[stop.requested]


def _summary(found: Diagnosis, console: Console) -> None:
    told = found.assessment
    console.print(f"[bold]{escape(headline(found))}[/]", highlight=False)
    for sentence in filter(None, (alike(found), nearest(found))):
        console.print(escape(sentence), highlight=False)
    if sentence := imperfections(found):
        console.print(escape(sentence), highlight=False)
    for warning in found.warnings:
        console.print(f"warning: {escape(warning)}", highlight=False)
    print_table(console, _breakdown_table(found))
    for sentence in (largest_parts(found), largest_residual(found)):
        console.print(escape(sentence), highlight=False)
    if found.verdict.effects:
        print_table(console, _parameter_table(as_json(found)["parameters"], "What explains it"), keys=2)
    elif found.assessment.nearest.effects:
        parameters = as_json(found)["nearest"]["parameters"]
        print_table(console, _parameter_table(parameters, "What comes nearest"), keys=2)
    print_table(console, _ranking_table(found))
    if told.detection_limits and not found.verdict.effects:
        print_table(console, _limits_table(found))
    if told.next_experiment:
        console.print(f"next: {escape(told.next_experiment)}", highlight=False)
    for sentence in unidentifiable(found.log):
        console.print(f"open: {escape(sentence)}", highlight=False)


def _breakdown_table(found: Diagnosis) -> Table:
    table = Table("where", "nominal", "explained", title="Residual / σ")
    before, after = found.assessment.breakdown, found.assessment.breakdown_after
    for (name, gap), (_, left) in zip(_by_part(before), _by_part(after), strict=True):
        table.add_row(name, f"{gap:.2f}", f"{left:.2f}")
    return table


def _by_part(parts: ResidualBreakdown) -> Iterator[tuple[str, float]]:
    yield from parts.signal.items()
    yield from parts.phase.items()
    for low, high, value in parts.band_hz:
        yield f"{low:g} to {high:g} Hz", value
    for depth, value in parts.depth_mm:
        yield f"{depth:g} mm deep", value


def _parameter_table(parameters: Mapping[str, Any], title: str) -> Table:
    table = Table("effect", "parameter", "value", "95 % interval", "unit", title=title)
    for effect, values in parameters.items():
        for name, p in values.items():
            interval = f"{p['low']:.4g} .. {p['high']:.4g}"
            table.add_row(effect, name, f"{p['value']:.4g}", interval, p["unit"])
    return table


def _limits_table(found: Diagnosis) -> Table:
    table = Table("effect", "may be present and go unseen", title="Detection limits")
    for effect, values in found.assessment.detection_limits.items():
        table.add_row(effect, limit_in_words(effect, values))
    return table


def _ranking_table(found: Diagnosis) -> Table:
    table = Table("explanation", "probability", title="Ranking")
    for name, probability in found.verdict.ranking[:5]:
        if probability >= _SHOWN:
            table.add_row(name, f"{probability:.3f}")
    return table

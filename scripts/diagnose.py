"""`needle diagnose`: which effects the nominal model of a rig lacks."""

import json
import time
from collections.abc import Iterator, Mapping
from datetime import date
from functools import partial
from pathlib import Path
from typing import Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from diagnosis.assessment.identifiability import unidentifiable
from diagnosis.freeform.save import as_file, file_of
from diagnosis.in_sigma import over_sigma
from diagnosis.log.rig_log import RigLog, files_of, read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.answer import answer
from diagnosis.report.json_report import as_json
from diagnosis.report.sensors import imperfections
from diagnosis.report.sentences.names import explanations, label_of
from diagnosis.report.sentences.nearest import (
    NOT_AN_EXPLANATION,
    about_as_near,
    differing_motions,
    differing_trials,
)
from diagnosis.report.sentences.residual import largest_parts, largest_residual
from diagnosis.report.tables import interval_rows, limit_in_words
from diagnosis.report.write import load_libraries, output_paths, write_report
from diagnosis.residuals.residual_breakdown import ResidualBreakdown, band_name
from diagnosis.result import Diagnosis
from diagnosis.selection.verdicts.verdict import VerdictKind
from diagnosis.stopping import StoppedEarly, StopSignal
from models.errors import UnwritableOutput
from scripts.exit_codes import ExitCode
from scripts.output_folder import output_folder
from scripts.progress_line import progress_line
from scripts.results import tell
from scripts.stop_signals import EXIT_CODES, stops_on_signals
from scripts.streams import complain
from scripts.tables import print_table
from scripts.terminal import terminal
from sim.files import Destination, finish_interrupted, write_text
from sim.simulation import prepare_processes

DEFAULT = Path("out/diagnose")
_REPORT_LEAST_S = 4.0  # kept of a limit for the report
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
    save_effect: str | None = None,
) -> int:
    """Diagnose a log; prints a summary, or `report.json`.

    Args:
      out: folder of the report; None: a default folder, or none with `json_only`.
      limit_s: time limit for everything, s; None: no limit.
      began_s: `time.monotonic()` from which the limit counts; None: now.
      save_effect: name under which a free-form law that closes the gap is saved; None: it is not saved.

    Returns:
      0, or 128 + the number of the signal that stopped the diagnosis early.
    """
    effect_file = _effect_file(save_effect, force=force)
    writes = out is not None or not json_only
    stop = _stop(limit_s, began_s, writes=writes)
    log = _read(log_folder)
    outputs, inputs = partial(output_paths, log), files_of(log, log_folder)
    destination = output_folder(out, DEFAULT, outputs, inputs=inputs, force=force) if writes else None
    prepare_processes()  # compiles for half a minute the first time, before there is anything to tell
    with stops_on_signals(stop):
        try:
            found = _diagnosed(log, stop, writes=writes)
        except StoppedEarly as early:
            if not stop.requested:
                raise
            complain(f"needle diagnose: {early}")
            return EXIT_CODES[stop.requested]
        code = _delivered(found, destination, console, json_only=json_only)
        if save_effect and effect_file:
            _save(found, save_effect, effect_file, force=force)
    return EXIT_CODES[stop.requested] or code


def _effect_file(save_effect: str | None, *, force: bool) -> Path | None:
    """The file of an effect that is to be saved, which may be written; None: none is to be."""
    if save_effect is None:
        return None
    path = file_of(save_effect)
    Destination(folder=path.parent, force=force).check([path])
    return path


def _stop(limit_s: float | None, began_s: float | None, *, writes: bool) -> StopSignal:
    """The stop at the time limit, with what the report needs kept of it."""
    used_s = time.monotonic() - began_s if began_s else 0.0
    reserve_s = max(_REPORT_LEAST_S, _REPORT_STARTS * used_s) if writes else 0.0
    return StopSignal(limit_s, began_s=began_s, reserve_s=reserve_s)


def _read(log_folder: Path) -> RigLog:
    """The log, with its warnings told."""
    finish_interrupted(log_folder)
    log = read_rig_log(log_folder)
    for warning in log.warnings:
        complain(f"warning: {warning}")
    return log


def _diagnosed(log: RigLog, stop: StopSignal, *, writes: bool) -> Diagnosis:
    """The diagnosis, with its progress shown; libraries of the report load meanwhile."""
    with progress_line(terminal(stderr=True), stop) as show:
        return diagnose(
            log,
            stop=stop,
            progress=show,
            diagnosed_on=date.today(),
            meanwhile=load_libraries if writes else None,
        )


def _delivered(
    found: Diagnosis, destination: Destination | None, console: Console, *, json_only: bool
) -> ExitCode:
    """Write the report and show the answer, which is shown where the report cannot be written, too."""
    try:
        written = write_report(found, destination) if destination else None
    except UnwritableOutput:
        _show(found, console, json_only=json_only)
        raise
    _show(found, console, json_only=json_only)
    return tell(written, console, shown=() if json_only else None) if written else ExitCode.DONE


def _show(found: Diagnosis, console: Console, *, json_only: bool) -> None:
    if json_only:
        console.print_json(json.dumps(as_json(found)))
    else:
        _summary(found, console)


def _save(found: Diagnosis, name: str, path: Path, *, force: bool) -> None:
    """Save the law, or say why there is none."""
    text = as_file(found.missing, name)
    if not text:
        complain(f"{name} is not saved: no free-form law closes the gap that the library leaves")
        return
    write_text(path, text, force=force)
    complain(f"saved      {path}: later diagnoses will try {name}")


def _summary(found: Diagnosis, console: Console) -> None:
    told = found.assessment
    what, sure, then = answer(found)
    console.print(Text(what, "bold"))
    for sentence in (sure, then):
        console.print(sentence, highlight=False)
    sentence = imperfections(found)
    if sentence and found.verdict.kind is not VerdictKind.NONE:  # which begins with it
        console.print(sentence, highlight=False)
    for warning in found.warnings:
        if warning not in found.log.warnings:  # those were told while the log was read
            console.print(f"warning: {warning}", highlight=False)
    print_table(console, _breakdown_table(found))
    for sentence in (largest_parts(found), largest_residual(found)):
        console.print(sentence, highlight=False)
    if found.verdict.effects:
        print_table(console, _parameter_table(as_json(found)["parameters"], "What explains it"), keys=2)
    elif found.assessment.nearest.effects:
        parameters = as_json(found)["nearest"]["parameters"]
        print_table(console, _parameter_table(parameters, "What comes nearest"), keys=2)
        console.print(NOT_AN_EXPLANATION, highlight=False)
        more = (about_as_near(found), differing_trials(found), differing_motions(found))
        for sentence in filter(None, more):
            console.print(f"{sentence}.", highlight=False)
    if found.verdict.kind is not VerdictKind.UNKNOWN:  # then no explanation has a probability
        print_table(console, _ranking_table(found))
    if told.detection_limits and not found.verdict.effects:
        print_table(console, _limits_table(found))
    for sentence in unidentifiable(found.log):
        console.print(f"open: {sentence}", highlight=False)


def _breakdown_table(found: Diagnosis) -> Table:
    table = Table(
        "where", "nominal", label_of(found, "explained"), title="Residual / σ, fitted to all trials"
    )
    before, after = found.assessment.breakdown, found.assessment.breakdown_after
    for (name, gap), (_, left) in zip(_by_part(before), _by_part(after), strict=True):
        table.add_row(name, over_sigma(gap), over_sigma(left))
    return table


def _by_part(parts: ResidualBreakdown) -> Iterator[tuple[str, float]]:
    yield from parts.signal.items()
    yield from parts.phase.items()
    for low, high, value in parts.band_hz:
        yield band_name(low, high), value
    for depth, value in parts.depth_mm:
        yield f"{depth:g} mm deep", value


def _parameter_table(parameters: Mapping[str, Any], title: str) -> Table:
    table = Table("effect", "parameter", "value", "95 % interval", "unit", title=title)
    for effect, values in parameters.items():
        for name, value, low, high, unit in interval_rows(values):
            table.add_row(effect, name, value, f"{low} .. {high}", unit)
    return table


def _limits_table(found: Diagnosis) -> Table:
    table = Table("effect", "may be present and go unseen", title="Detection limits")
    for effect, limit in found.assessment.detection_limits.items():
        table.add_row(effect, limit_in_words(effect, limit.parameters))
    return table


def _ranking_table(found: Diagnosis) -> Table:
    table = Table("explanation", "probability", title="Ranking")
    for name, probability in explanations(found)[:5]:
        table.add_row(name, f"{probability:.3f}")
    return table

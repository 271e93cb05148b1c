"""`needle diagnose`: which effects the nominal model of a rig lacks."""

import json
import time
from datetime import date
from functools import partial
from pathlib import Path

from rich.console import Console

from diagnosis.freeform.save import as_file, file_of
from diagnosis.log.rig_log import RigLog, files_of, read_rig_log
from diagnosis.pipeline import diagnose
from diagnosis.report.json_report import as_json
from diagnosis.report.write import load_libraries, output_paths, write_report
from diagnosis.result import Diagnosis
from diagnosis.stopping import StoppedEarly, StopSignal
from models.errors import UnwritableOutput
from scripts.diagnosis_summary import summary
from scripts.exit_codes import ExitCode
from scripts.output_folder import output_folder
from scripts.progress_line import progress_line
from scripts.results import tell
from scripts.stop_signals import EXIT_CODES, stops_on_signals
from scripts.streams import complain
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
        summary(found, console)


def _save(found: Diagnosis, name: str, path: Path, *, force: bool) -> None:
    """Save the law, or say why there is none."""
    text = as_file(found.missing, name)
    if not text:
        complain(f"{name} is not saved: no free-form law closes the gap that the library leaves")
        return
    write_text(path, text, force=force)
    complain(f"saved      {path}: later diagnoses will try {name}")

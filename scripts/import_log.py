"""`needle import`: a lab's files as a rig-log/1 folder, by a mapping that the user confirms."""

from collections.abc import Sequence
from functools import partial
from pathlib import Path

from rich.console import Console
from rich.table import Table

from diagnosis.lab_files.draft_file import loop_lines, mapping_text
from diagnosis.lab_files.guesses.draft import Draft, drafted
from diagnosis.lab_files.preview import write_preview
from diagnosis.lab_files.read_mapping import read_mapping
from diagnosis.lab_files.readers.lab_table import LabFile
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.write_log import imported, log_paths, read_back, write_log
from scripts.output_folder import output_folder
from scripts.results import tell
from scripts.tables import print_table
from sim.files import publishing, write_text

DEFAULT = Path("out/import")
_FIELDS = ("column", "unit", "derive", "sign", "zero", "time_offset_s")


def run(
    paths: Sequence[Path],
    out: Path | None,
    *,
    mapping: Path | None,
    accept_guesses: bool,
    force: bool,
    console: Console,
) -> int:
    """Draft a mapping, or apply one."""
    files = read_lab_files(paths)
    for note in (note for file in files for note in file.notes):
        console.print(f"note: {note}", highlight=False)
    if mapping is None:
        return _draft(files, out, force=force, console=console)
    return _write(files, out, mapping, accept_guesses=accept_guesses, force=force, console=console)


def _draft(files: Sequence[LabFile], out: Path | None, *, force: bool, console: Console) -> int:
    inputs = tuple(file.path for file in files)
    destination = output_folder(out, DEFAULT, _draft_paths, inputs=inputs, force=force)
    paths = _draft_paths(destination.folder)
    draft = drafted(files)
    with publishing(destination, paths) as written:
        write_text(written.at(paths[0]), mapping_text(draft))
        written.optional(paths[1], partial(write_preview, draft))
    print_table(console, table(draft), keys=2)
    for item in draft.open:
        console.print(f"to fill in: {item}", highlight=False)
    for line in loop_lines(draft):
        console.print(f"loops: {line}", highlight=False)
    code = tell(written, console)
    names = " ".join(str(file.path) for file in files)
    console.print(
        f"next: look at preview.png, edit mapping.yaml, then\n  needle import {names} "
        f"--map {paths[0]} --out LOG",
        highlight=False,
        soft_wrap=True,
    )
    return code


def _draft_paths(folder: Path) -> list[Path]:
    return [folder / "mapping.yaml", folder / "preview.png"]


def table(draft: Draft) -> Table:
    """Every guess with its reason."""
    shown = Table("column", "field", "guess", "because", title="Guesses: please check each one")
    for time in draft.times:
        shown.add_row("time_s", "column", time.source.column, time.because)
        shown.add_row("", "unit", _shown(time.source.unit), time.reason, end_section=True)
    for column in draft.columns:
        fields = [name for name in _FIELDS if name in column.reasons]
        for i, name in enumerate(fields):
            shown.add_row(
                "" if i else column.wanted,
                name,
                _shown(getattr(column.source, name)),
                column.reasons[name],
                end_section=i == len(fields) - 1,
            )
    for sensor, value in draft.noise.items():
        if value is not None:
            shown.add_row("sensors", sensor, f"{value:g}", "scatter of the readings at rest")
    return shown


def _shown(value: object) -> str:
    if value is None:
        return "unknown: fill in"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _write(
    files: Sequence[LabFile],
    out: Path | None,
    path: Path,
    *,
    accept_guesses: bool,
    force: bool,
    console: Console,
) -> int:
    mapping = read_mapping(path, accept_guesses=accept_guesses)
    outputs, inputs = partial(log_paths, mapping), (path, *(file.path for file in files))
    destination = output_folder(out, DEFAULT, outputs, inputs=inputs, force=force)
    trials = imported(mapping, files)
    log = read_back(mapping, trials)
    written = write_log(mapping, trials, destination)
    for note in (note for trial in trials for note in trial.notes):
        console.print(note, highlight=False)
    code = tell(written, console)
    for warning in log.warnings:
        console.print(f"warning: {warning}", highlight=False)
    count, trials_read = len(log.warnings), len(log.trials)
    said = "no warnings" if not count else f"{count} warning{'s' if count > 1 else ''}"
    console.print(
        f"read back: {trials_read} trial{'s' if trials_read > 1 else ''}, {said}", highlight=False
    )
    return code

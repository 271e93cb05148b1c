"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

from functools import partial
from pathlib import Path

from rich.console import Console

from scripts.control_tables import (
    failures_table,
    integral_table,
    robustness_tables,
    settling_table,
)
from scripts.output_folder import output_folder
from scripts.progress_line import ByShare, stage_line, within
from scripts.results import tell
from scripts.steering_tables import steering_tables
from scripts.tables import print_table
from sim.files import Destination, ResultSet, publishing
from sim.recording.rerun_log import log_recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.recordings import StepRecording, stems, step_recordings
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.steering.steered_insertions import STEERED, SteeredInsertion, TurnOrder
from studies.control.study import run_study

DEFAULT = Path("out/control")
_HANKEL = (
    "Hankel singular values of torque to tip at 20 cm, over the largest (an estimator can leave out the "
    "modes of small ones)"
)
_STUDY_SHARE, _PICTURES_SHARE = 0.8, 0.84  # of the time, until the study and its pictures are done


def run(out: Path | None, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    destination = output_folder(out, DEFAULT, output_paths, force=force)
    with stage_line() as stage:
        study = run_study(within(stage, 0.0, _STUDY_SHARE))
        written = _write(study, destination, stage)
    show(study, console)
    return tell(written, console, shown=_told(written, destination.folder))


def output_paths(folder: Path) -> list[Path]:
    """Every file of the study."""
    files = (folder / name for name in FILES)
    return [*files, *_recordings(folder).values(), *_steps(folder).values()]


def _steps(folder: Path) -> dict[str, Path]:
    return {stem: folder / f"{stem}.rrd" for stem in stems()}


def _told(written: ResultSet, folder: Path) -> list[Path | str]:
    """Names of the written files: the many recordings of steps in one line, the others one by one."""
    steps = {*_steps(folder).values()}
    others = [path for path in written.made if path not in steps]
    count = len(written.made) - len(others)
    return [f"{count} recordings of steps, {folder}/turn_*.rrd and robust_*.rrd", *others]


def _write(study: ControlStudy, destination: Destination, stage: ByShare) -> ResultSet:
    folder = destination.folder
    recordings, files = _recordings(folder), _steps(folder)
    with publishing(destination, output_paths(folder)) as written:
        stage("drawing", _STUDY_SHARE)
        recording = within(stage, _PICTURES_SHARE)
        write_study(study, written, folder)
        for order, insertions in study.steering.steered.items():
            for one in insertions:
                if one.controlled is not None:  # a baseline has no recording
                    written.optional(recordings[order, one.name], partial(_record, one, order))
        steps = step_recordings(study.tables, study.robustness)
        for i, step in enumerate(steps):
            recording("recording steps", i / len(steps))
            written.optional(files[step.stem], partial(_record_step, step))
    return written


def _recordings(folder: Path) -> dict[tuple[TurnOrder, str], Path]:
    """Files of the steered insertions; for the paper's order of turns, named by controller only."""
    prefix = {TurnOrder.TO_AND_FRO: "", TurnOrder.WINDING: "winding_"}
    return {
        (order, name): folder / f"steered_{prefix[order]}{name}.rrd"
        for order in TurnOrder
        for name in STEERED[2:]
    }


def _record_step(step: StepRecording, path: Path) -> None:
    log_recording(step.make(), path, results=step.results)


def _record(one: SteeredInsertion, order: TurnOrder, path: Path) -> None:
    """Write one insertion as a recording."""
    assert one.controlled is not None
    turns = " ".join(f"{roll:g}" for roll in order.rolls_deg)
    about = {"protocol": f"steered, {one.name}", "description": f"rolls of {turns} deg over 7 cm"}
    result = f"largest deviation from the plane: {one.out_of_plane_mm:.2f} mm"
    recording = record_closed_loop(one.controlled, about)
    log_recording(recording, path, results=[result])


def show(study: ControlStudy, console: Console) -> None:
    """Print every table."""
    print_table(console, settling_table(study.tables), keys=3)
    print_table(console, integral_table(study.tables), keys=3)
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"{_HANKEL}: {ratios}", highlight=False)
    for table in robustness_tables(study.robustness):
        print_table(console, table)
    print_table(console, failures_table(study.robustness), keys=2)
    for table, keys in steering_tables(study.steering):
        print_table(console, table, keys=keys)

"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

from pathlib import Path

from rich.console import Console

from scripts.control_tables import (
    failures_table,
    integral_table,
    robustness_tables,
    settling_table,
)
from scripts.output_folder import output_folder, say_written
from scripts.progress_line import ByShare, stage_line
from scripts.steering_tables import steering_tables
from scripts.tables import print_table
from sim.recording.rerun_log import log_recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.recordings import stems, step_recordings
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.steering.steered_insertions import STEERED, SteeredInsertion, TurnOrder
from studies.control.study import run_study

DEFAULT = Path("out/control")
_STUDY_SHARE, _PICTURES_SHARE = 0.8, 0.84  # of the time, until the study and its pictures are done


def run(out: Path | None, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    folder = output_folder(out, DEFAULT, output_paths, force=force)
    with stage_line() as stage:
        study = run_study(lambda what, share: stage(what, _STUDY_SHARE * share))
        paths = _write(study, folder, stage, force=force)
    show(study, console)
    steps = len(stems())
    recorded = f"{steps} recordings of steps, {folder}/turn_*.rrd and robust_*.rrd"
    say_written(console, [recorded, *paths, *_recordings(folder).values()])
    return 0


def output_paths(folder: Path) -> list[Path]:
    """Every file of the study."""
    steps = (folder / f"{stem}.rrd" for stem in stems())
    return [*(folder / name for name in FILES), *_recordings(folder).values(), *steps]


def _write(study: ControlStudy, folder: Path, stage: ByShare, *, force: bool) -> list[Path]:
    stage("drawing", _STUDY_SHARE)
    paths = write_study(study, folder, force=force)
    for order, insertions in study.steering.steered.items():
        for one in insertions:
            _record(one, order, _recordings(folder), force=force)
    steps = step_recordings(study.tables, study.robustness)
    for i, step in enumerate(steps):
        stage("recording steps", _PICTURES_SHARE + (1.0 - _PICTURES_SHARE) * i / len(steps))
        log_recording(step.make(), folder / f"{step.stem}.rrd", results=step.results, force=force)
    return paths


def _recordings(folder: Path) -> dict[tuple[TurnOrder, str], Path]:
    """Files of the steered insertions; those as in the paper carry the controller's name alone."""
    prefix = {TurnOrder.TO_AND_FRO: "", TurnOrder.WINDING: "winding_"}
    return {
        (order, name): folder / f"steered_{prefix[order]}{name}.rrd"
        for order in TurnOrder
        for name in STEERED[2:]
    }


def _record(
    one: SteeredInsertion,
    order: TurnOrder,
    recordings: dict[tuple[TurnOrder, str], Path],
    *,
    force: bool,
) -> None:
    """Write one insertion as a recording; a baseline has none."""
    if one.controlled is None:
        return
    turns = " ".join(f"{roll:g}" for roll in order.rolls_deg)
    about = {"protocol": f"steered, {one.name}", "description": f"rolls of {turns} deg over 7 cm"}
    result = f"largest deviation from the plane: {one.out_of_plane_mm:.2f} mm"
    recording = record_closed_loop(one.controlled, about)
    log_recording(recording, recordings[order, one.name], results=[result], force=force)


def show(study: ControlStudy, console: Console) -> None:
    """Print every table."""
    print_table(console, settling_table(study.tables), keys=3)
    print_table(console, integral_table(study.tables), keys=3)
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel singular values of torque to tip at 20 cm, over the largest: {ratios}")
    for table in robustness_tables(study.robustness):
        print_table(console, table)
    print_table(console, failures_table(study.robustness), keys=2)
    for table, keys in steering_tables(study.steering):
        print_table(console, table, keys=keys)

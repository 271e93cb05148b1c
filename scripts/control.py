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
from scripts.results import tell
from scripts.steering_tables import steering_tables
from scripts.streams import waiting
from sim.files import Destination, publishing
from sim.recording.rerun_log import log_recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.recordings import StepRecording, stems, step_recordings
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.steering.steered_insertions import STEERED, SteeredInsertion, TurnOrder
from studies.control.study import run_study


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    recordings = _recordings(folder)
    steps = {stem: folder / f"{stem}.rrd" for stem in stems()}
    paths = [*(folder / name for name in FILES), *recordings.values(), *steps.values()]
    destination = Destination(folder=folder, force=force)
    destination.check(paths)
    with waiting("simulating closed loops") as status:
        study = run_study(lambda stage: status.update(f"simulating closed loops: {stage}"))
    with publishing(destination, paths) as written:
        write_study(study, written, folder)
        for order, insertions in study.steering.steered.items():
            for one in insertions:
                if one.controlled is not None:  # a baseline has no recording
                    written.optional(recordings[order, one.name], partial(_record, one, order))
        for step in step_recordings(study.tables, study.robustness):
            written.optional(steps[step.stem], partial(_record_step, step))
    show(study, console)
    return tell(written, console)


def _recordings(folder: Path) -> dict[tuple[TurnOrder, str], Path]:
    """Files of the steered insertions; those as in the paper carry the controller's name alone."""
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
    console.print(settling_table(study.tables))
    console.print(integral_table(study.tables))
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel singular values of torque to tip at 20 cm, over the largest: {ratios}")
    for table in (
        *robustness_tables(study.robustness),
        failures_table(study.robustness),
        *steering_tables(study.steering),
    ):
        console.print(table)

"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

import math
from pathlib import Path

from rich.console import Console
from rich.table import Table

from scripts.control_tables import (
    failures_table,
    integral_table,
    robustness_tables,
    settling_table,
)
from sim.files import refuse_existing
from sim.recording.rerun_log import log_recording
from studies.control import steering
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.recordings import stems, step_recordings
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.study import run_study


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    recordings = {name: folder / f"steered_{name}.rrd" for name in steering.STEERED[2:]}
    steps = {stem: folder / f"{stem}.rrd" for stem in stems()}
    written = [*(folder / name for name in FILES), *recordings.values(), *steps.values()]
    refuse_existing(written, force=force)
    with console.status("simulating closed loops") as status:
        study = run_study(lambda stage: status.update(f"simulating closed loops: {stage}"))
    show(study, console)
    paths = write_study(study, folder, force=force)
    for one in study.steered:
        if one.controlled is not None:
            about = {"protocol": f"steered, {one.name}", "description": "four half turns over 7 cm"}
            result = f"largest deviation from the plane: {one.out_of_plane_mm:.2f} mm"
            recording = record_closed_loop(one.controlled, about)
            log_recording(recording, recordings[one.name], results=[result], force=force)
    for step in step_recordings(study.tables, study.robustness):
        log_recording(step.make(), steps[step.stem], results=step.results, force=force)
    console.print(f"wrote      {len(steps)} recordings of steps, {folder}/turn_*.rrd and robust_*.rrd")
    for path in [*paths, *recordings.values()]:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def show(study: ControlStudy, console: Console) -> None:
    """Print every table."""
    console.print(settling_table(study.tables))
    console.print(integral_table(study.tables))
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel singular values of torque to tip at 20 cm, over the largest: {ratios}")
    for table in (*robustness_tables(study.robustness), failures_table(study.robustness)):
        console.print(table)
    console.print(_steered(study))
    console.print(_planes(study))


def _steered(study: ControlStudy) -> Table:
    table = Table(
        "insertion", "deviation from the plane, mm", "paper, mm", title="Steered insertions, Fig. 12"
    )
    for one in study.steered:
        printed = steering.PUBLISHED_MM.get(one.name)
        table.add_row(one.name, f"{one.out_of_plane_mm:.2f}", f"{printed:g}" if printed else "")
    return table


def _planes(study: ControlStudy) -> Table:
    title = "Planar controller: travel until within 0.5 mm of the plane, mm"
    table = Table("case", *(f"{speed:g} mm/s" for speed in study.planes), title=title)
    for i, name in enumerate(steering.PLANAR_CASES):
        travels = [approaches[i].converged_mm() for approaches in study.planes.values()]
        table.add_row(name, *("never" if math.isnan(t) else f"{t:.0f}" for t in travels))
    return table

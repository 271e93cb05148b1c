"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

import math
from pathlib import Path

from rich.console import Console
from rich.table import Table

from sim.files import refuse_existing
from sim.recording.rerun_log import log_recording
from studies.control import steering
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.study import run_study
from studies.control.tables import StepResponse


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    recordings = {name: folder / f"steered_{name}.rrd" for name in steering.STEERED[2:]}
    refuse_existing([folder / name for name in FILES] + list(recordings.values()), force=force)
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
    for path in [*paths, *recordings.values()]:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def show(study: ControlStudy, console: Console) -> None:
    """Print every table."""
    console.print(_responses("Tables IV and V: a step of 90 deg in viscous plastisol", study.tables))
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel singular values of torque to tip at 20 cm, over the largest: {ratios}")
    console.print(
        _responses(
            "Robustness: the same step in tissue that the estimator does not model", study.robustness
        )
    )
    console.print(_steered(study))
    console.print(_planes(study))


def _responses(title: str, responses: list[StepResponse]) -> Table:
    table = Table(title=title)
    for heading in ("tissue", "depth, cm", "free, mm", "controller"):
        table.add_column(heading)
    table.add_column("settling, s", justify="right")
    for heading in ("paper", "ratio", "improvement", "integral, deg s", "paper", "ratio", "improvement"):
        table.add_column(heading, justify="right")
    table.add_column("overshoot, deg", justify="right")
    table.add_column("")
    for o in responses:
        table.add_row(
            o.tissue,
            f"{o.depth_cm:g}",
            f"{o.free_mm:g}",
            o.controller,
            "never" if math.isnan(o.settle_s) else f"{o.settle_s:.2f}",
            _or_blank(o.published_settle_s, ".2f"),
            _or_blank(o.settle_s / o.published_settle_s, ".2f"),
            f"{o.settle_better:.0f} %",
            f"{o.integral_deg_s:.1f}",
            _or_blank(o.published_integral_deg_s, ".1f"),
            _or_blank(o.integral_deg_s / o.published_integral_deg_s, ".2f"),
            f"{o.integral_better:.0f} %",
            f"{o.overshoot_deg:.1f}",
            "[red]worse than base only[/]" if o.worse_than_none else "",
        )
    return table


def _or_blank(value: float, shape: str) -> str:
    return "" if math.isnan(value) else format(value, shape)


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

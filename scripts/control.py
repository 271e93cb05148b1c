"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

import math
from pathlib import Path

from rich.console import Console
from rich.table import Table

from sim.control import steering
from sim.control.recording import record_flight
from sim.control.report import FILES, ControlStudy, hankel, write_study
from sim.control.study import run_study
from sim.control.tables import Outcome
from sim.files import refuse_existing
from sim.rerun_log import log_recording


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    recordings = {name: folder / f"steered_{name}.rrd" for name in steering.STEERED[2:]}
    refuse_existing([folder / name for name in FILES] + list(recordings.values()), force=force)
    with console.status("flying") as status:
        study = run_study(lambda stage: status.update(f"flying: {stage}"))
    show(study, console)
    paths = write_study(study, folder, force=force)
    for one in study.steered:
        if one.flight is not None:
            about = {"protocol": f"steered, {one.name}", "description": "four half turns over 7 cm"}
            verdict = f"out of the plane: {one.out_of_plane_mm:.2f} mm"
            recording = record_flight(one.flight, about)
            log_recording(recording, recordings[one.name], verdicts=[verdict], force=force)
    for path in [*paths, *recordings.values()]:
        console.print(f"wrote      {path}", highlight=False)
    return 0


def show(study: ControlStudy, console: Console) -> None:
    """Every table on the screen."""
    console.print(_outcomes("Tables IV and V: a turn of 90 deg in viscous plastisol", study.tables))
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel values of torque to tip at 20 cm, over the largest: {ratios}")
    console.print(_outcomes("Robustness: the estimator does not know the tissue", study.robustness))
    console.print(_steered(study))
    console.print(_planes(study))


def _outcomes(title: str, outcomes: list[Outcome]) -> Table:
    table = Table(title=title)
    for heading in ("tissue", "depth, cm", "free, mm", "controller"):
        table.add_column(heading)
    table.add_column("settles, s", justify="right")
    for heading in ("paper", "ratio", "better", "integral, deg s", "paper", "ratio", "better"):
        table.add_column(heading, justify="right")
    table.add_column("overshoot, deg", justify="right")
    table.add_column("")
    for o in outcomes:
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
            "[red]worse than none[/]" if o.worse_than_none else "",
        )
    return table


def _or_blank(value: float, shape: str) -> str:
    return "" if math.isnan(value) else format(value, shape)


def _steered(study: ControlStudy) -> Table:
    table = Table("insertion", "out of the plane, mm", "paper, mm", title="Steered insertions, Fig. 12")
    for one in study.steered:
        printed = steering.PUBLISHED_MM.get(one.name)
        table.add_row(one.name, f"{one.out_of_plane_mm:.2f}", f"{printed:g}" if printed else "")
    return table


def _planes(study: ControlStudy) -> Table:
    title = "Planar controller: travel until within 0.5 mm of the plane, mm"
    table = Table("world", *(f"{speed:g} mm/s" for speed in study.planes), title=title)
    for i, name in enumerate(steering.PLANES):
        travels = [held[i].converged_mm() for held in study.planes.values()]
        table.add_row(name, *("never" if math.isnan(t) else f"{t:.0f}" for t in travels))
    return table

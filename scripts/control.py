"""`needle control`: Tables IV and V, robustness, steered insertions, the planar controller."""

import math
from pathlib import Path

from rich.console import Console
from rich.table import Table

from scripts.steering_tables import steering_tables
from sim.files import refuse_existing
from sim.recording.rerun_log import log_recording
from studies.control.closed_loop_recording import record_closed_loop
from studies.control.report import FILES, ControlStudy, hankel, write_study
from studies.control.steering.steered_insertions import STEERED, SteeredInsertion, TurnOrder
from studies.control.study import run_study
from studies.control.tables import StepResponse


def run(folder: Path, *, force: bool, console: Console) -> int:
    """Run everything, print the tables and write the study."""
    recordings = _recordings(folder)
    refuse_existing([folder / name for name in FILES] + list(recordings.values()), force=force)
    with console.status("simulating closed loops") as status:
        study = run_study(lambda stage: status.update(f"simulating closed loops: {stage}"))
    show(study, console)
    paths = write_study(study, folder, force=force)
    for order, insertions in study.steering.steered.items():
        for one in insertions:
            _record(one, order, recordings, force=force)
    for path in [*paths, *recordings.values()]:
        console.print(f"wrote      {path}", highlight=False)
    return 0


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
    console.print(_responses("Tables IV and V: a step of 90 deg in viscous plastisol", study.tables))
    ratios = ", ".join(f"{x:.2g}" for x in hankel())
    console.print(f"Hankel singular values of torque to tip at 20 cm, over the largest: {ratios}")
    console.print(
        _responses(
            "Robustness: the same step in tissue that the estimator does not model", study.robustness
        )
    )
    for table in steering_tables(study.steering):
        console.print(table)


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

"""The tables of `needle control` that are about steering."""

import math

from rich.table import Table

from studies.control.steering.planar_spread import PlanarSpread
from studies.control.steering.planar_study import PLANAR_CASES
from studies.control.steering.seed_spread import Spread
from studies.control.steering.steered_insertions import PUBLISHED_MM, STEERED
from studies.control.steering.steering_study import SteeringStudy


def steering_tables(study: SteeringStudy) -> list[tuple[Table, int]]:
    """Every table, in the order of the stages, with the number of columns that name its rows."""
    named_by_one = (_steered(study), _known_pose(study), _travels(study), _heights(study))
    return [*((table, 1) for table in named_by_one), (_fused(study), 2), (_spun(study), 3)]


def _steered(study: SteeringStudy) -> Table:
    title = "Steered insertions, Fig. 12: largest deviation from the plane, mm"
    table = Table("insertion", *(order.value.replace("_", " ") for order in study.steered), title=title)
    table.add_column("paper (to and fro)")
    table.add_column("ratio")
    by_order = [{one.name: one.out_of_plane_mm for one in s} for s in study.steered.values()]
    for name in STEERED:
        found = [f"{heights[name]:.2f}" for heights in by_order]
        printed = PUBLISHED_MM.get(name)
        ratio = f"{by_order[0][name] / printed:.2f}" if printed else ""
        table.add_row(name, *found, f"{printed:g}" if printed else "", ratio)
    return table


def _known_pose(study: SteeringStudy) -> Table:
    title = "Planar controller, pose known: travel until within 0.5 mm of the plane, mm"
    table = Table("case", *(f"{speed:g} mm/s" for speed in study.known_pose), title=title)
    for i, name in enumerate(PLANAR_CASES):
        travels = [approaches[i].converged_mm() for approaches in study.known_pose.values()]
        table.add_row(name, *(_or_never(t) for t in travels))
    return table


def _travels(study: SteeringStudy) -> Table:
    title = "Planar controller, images: travel until within 0.5 mm, median (range) of the seeds, mm"
    table = Table("case", *(f"{speed:g} mm/s" for speed in study.imaged), title=title)
    for name in PLANAR_CASES:
        table.add_row(name, *(_travel(PlanarSpread.of(by[name])) for by in study.imaged.values()))
    return table


def _travel(spread: PlanarSpread) -> str:
    return _shown(spread.converged_mm, ".0f") + (f", never in {spread.never}" if spread.never else "")


def _heights(study: SteeringStudy) -> Table:
    title = "Planar controller, images: height after 100 mm, rms, median (range) of the seeds, mm"
    table = Table("case", *(f"{speed:g} mm/s" for speed in study.imaged), title=title)
    for name in PLANAR_CASES:
        spreads = [PlanarSpread.of(by[name]).rms_mm for by in study.imaged.values()]
        table.add_row(name, *(_shown(spread, ".2f") for spread in spreads))
    return table


def _fused(study: SteeringStudy) -> Table:
    title = "Roll of the tip from base and images: error, median (range) of the seeds, deg"
    table = Table("needle", "estimator", "rms, second half", "at the end", title=title)
    for plant, by_estimator in study.fused.items():
        for name, errors in by_estimator.items():
            table.add_row(plant, name, _shown(errors.rms_deg, ".1f"), _shown(errors.end_deg, ".1f"))
    return table


def _spun(study: SteeringStudy) -> Table:
    title = "Duty-cycled spinning: curvature / curvature of a tip that is held, and its direction"
    table = Table(
        "controller",
        "start, cm",
        "duty cycle",
        "1 - duty cycle",
        "curvature",
        "direction, deg",
        title=title,
    )
    for one in study.spun:
        direction = "" if math.isnan(one.direction_deg) else f"{round(one.direction_deg)}"
        row = (one.case, f"{one.start_mm / 10:g}", f"{one.duty:g}", f"{1 - one.duty:.2f}")
        table.add_row(*row, f"{one.share:.2f}", direction)
    return table


def _shown(spread: Spread, shape: str) -> str:
    median, least, largest = (
        _or_never(value, shape) for value in (spread.median, spread.least, spread.largest)
    )
    return f"{median} ({least} to {largest})"


def _or_never(value: float, shape: str = ".0f") -> str:
    return "never" if math.isnan(value) else format(value, shape)

"""The columns of Tables IV and V that the paper's compensator earned.

Its gains and its motor are not stated, so these figures say nothing certain of the rig:
they stand beside what this project's compensators do on the stated one.
"""

from dataclasses import dataclass

from diagnosis.paper.tried import READINGS, stated
from models import published
from models.materials import MATERIALS
from studies.control.tables import response_metrics, turn

_COLUMNS = {"feedforward": 1, "feedback": 2}  # of the published tables


@dataclass(frozen=True, kw_only=True)
class Compensated:
    """A figure of the compensator's columns beside ours, whose gain and motor are our own."""

    name: str
    reading: str
    published: float
    ours: float
    unit: str


def compensated() -> tuple[Compensated, ...]:
    """Tables IV and V, feedforward and feedback, on the stated rig."""
    tissue, found = MATERIALS["viscous-plastisol"], []
    tables = (
        ("Table IV", published.TABLE_IV_SETTLE_S, "s"),
        ("Table V", published.TABLE_V_INTEGRAL_DEG_S, "s deg"),
    )
    for controller, column in _COLUMNS.items():
        for depth in published.TABLE_IV_SETTLE_S:
            for base in READINGS:
                run = turn(controller, depth_cm=depth, free_mm=base.free_mm, tissue=tissue).run
                ours = response_metrics(run)
                found += [
                    Compensated(
                        name=f"{table}, {controller}, {depth:g} cm",
                        reading=stated(base).reading,
                        published=printed[depth][column],
                        ours=float(value),
                        unit=unit,
                    )
                    for (table, printed, unit), value in zip(tables, ours, strict=False)
                ]
    return tuple(found)

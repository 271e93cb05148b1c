"""The columns of Tables IV and V that the paper measured with its torsion compensator.

The paper states neither gains nor motor, so these figures cannot test the rig: they are
printed beside results of this project's compensators on the stated rig.
"""

from collections.abc import Iterable
from dataclasses import dataclass

from models import published
from models.materials import MATERIALS
from studies.control.step_response import response_metrics, turn
from studies.published.experiments.rig import STATED_RIGS, PublishedRig
from studies.published.fitting.hypothesis import stated

_COLUMNS = {"feedforward": 1, "feedback": 2}  # of the published tables
_TABLES = (
    ("Table IV", published.TABLE_IV_SETTLE_S, "s"),
    ("Table V", published.TABLE_V_INTEGRAL_DEG_S, "s deg"),
)


@dataclass(frozen=True, kw_only=True)
class CompensatorFigure:
    """A figure of the compensator's columns beside ours, with this project's gain and motor.

    Attributes:
      name: table, controller and depth.
      free_length: of the simulated rig, in words.
      published, simulated: in `unit`.
    """

    name: str
    free_length: str
    published: float
    simulated: float
    unit: str


def compensator_figures(rigs: Iterable[PublishedRig] = STATED_RIGS) -> tuple[CompensatorFigure, ...]:
    """Tables IV and V, feedforward and feedback, on the stated rig with each free length."""
    chosen = tuple(rigs)
    return tuple(
        figure
        for controller in _COLUMNS
        for depth_cm in published.TABLE_IV_SETTLE_S
        for rig in chosen
        for figure in _figures(controller, depth_cm, rig)
    )


def _figures(controller: str, depth_cm: float, rig: PublishedRig) -> list[CompensatorFigure]:
    tissue = MATERIALS["viscous-plastisol"]
    run = turn(controller, depth_cm=depth_cm, free_mm=rig.free_mm, tissue=tissue).run
    return [
        CompensatorFigure(
            name=f"{table}, {controller}, {depth_cm:g} cm",
            free_length=stated(rig).free_length,
            published=printed[depth_cm][_COLUMNS[controller]],
            simulated=float(value),
            unit=unit,
        )
        for (table, printed, unit), value in zip(_TABLES, response_metrics(run), strict=False)
    ]

"""Figs. 11 and 12: 7 cm at 5 mm/s with a half turn after each of the first 4 cm.

The path of the tip follows from the roll of MuJoCo's tip. While the tip turns from one side to
the other, it pulls out of the plane. If it turns to and fro (0, 180, 0, 180, 0), it
passes through the same side four times, and the deviations add up. The paper turned its needle
in this way, since it says that alternating between tip up and tip down "would reduce the
height deviation". If the tip always turns in one sense (0, 180, 360, 540, 720), the sides alternate.
Published: 12 mm out of the plane without compensation, 4 mm with.
"""

from dataclasses import dataclass
from enum import StrEnum
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from models.bevel import path_mm
from models.materials import MATERIALS
from models.tissue import Tissue
from sim.closed_loop import ClosedLoopRun, run_closed_loop
from sim.schedule import Schedule
from studies.control.steering.insertion_setup import lagrangian_setup
from studies.control.tables import DESIGN
from studies.control.tip_controllers import tip_controller_named

Array = NDArray[np.float64]

PUBLISHED_MM = {"base_only": 12.0, "feedforward": 4.0}
STEERED = ("baseline_right", "baseline_left", "base_only", "feedforward", "least_time")
_SPEED_MM_S, _LENGTH_MM, _FREE_MM = 5.0, 70.0, 120.0
_STEP_S, _ELEMENTS = 0.005, 32


class TurnOrder(StrEnum):
    """The senses of four successive half turns."""

    TO_AND_FRO = "to_and_fro"
    """0, 180, 0, 180, 0: every transit through the same side, as in the paper."""
    WINDING = "winding"
    """0, 180, 360, 540, 720: transits through one side and the other in turn."""

    @property
    def rolls_deg(self) -> tuple[float, ...]:
        """Roll before the first half turn, and after each."""
        if self is TurnOrder.WINDING:
            return (0.0, 180.0, 360.0, 540.0, 720.0)
        return (0.0, 180.0, 0.0, 180.0, 0.0)


@dataclass(frozen=True, kw_only=True)
class SteeredInsertion:
    """An insertion and the path of its tip.

    Attributes:
      name: name of the controller, or of the baseline.
      controlled: the run; None for a baseline, which does not turn.
      path_mm: (N, 3); z is out of the plane of the baseline.
    """

    name: str
    controlled: ClosedLoopRun | None
    path_mm: Array

    @property
    def out_of_plane_mm(self) -> float:
        """Largest deviation from the plane of the baseline."""
        return float(np.abs(self.path_mm[:, 2]).max())


def half_turns(order: TurnOrder) -> Schedule:
    """7 cm at 5 mm/s; the reference steps by 180 deg after each of the first 4 cm."""
    rolls = order.rolls_deg
    time, angle = [0.0], [rolls[0]]
    for turn, (before, after) in enumerate(pairwise(rolls), start=1):
        at = turn * 10.0 / _SPEED_MM_S
        time += [at, at + 1e-6]
        angle += [before, after]
    times = np.array([*time, _LENGTH_MM / _SPEED_MM_S])
    depth = _SPEED_MM_S * times
    return Schedule(
        time_s=times,
        drive=np.array([*angle, rolls[-1]]),
        free_mm=_FREE_MM - depth,
        inserted_mm=depth,
        speed_mm_s=np.full(times.size, _SPEED_MM_S),
    )


def steered_insertions(
    order: TurnOrder,
    tissue: Tissue = MATERIALS["viscous-plastisol"],
    *,
    controllers: tuple[str, ...] = STEERED[2:],
) -> list[SteeredInsertion]:
    """Every insertion of Figs. 11 and 12, and one with this project's fastest controller."""
    turned = [_steered(name, half_turns(order), tissue) for name in controllers]
    return [_baseline("baseline_right", 0.0), _baseline("baseline_left", np.pi), *turned]


def _baseline(name: str, roll_rad: float) -> SteeredInsertion:
    arc = np.linspace(0.0, _LENGTH_MM, 701)
    return SteeredInsertion(
        name=name, controlled=None, path_mm=path_mm(arc, np.full(arc.size, roll_rad))
    )


def _steered(name: str, inputs: Schedule, tissue: Tissue) -> SteeredInsertion:
    controller = tip_controller_named(name, DESIGN)
    setup = lagrangian_setup(
        tissue, free_mm=_FREE_MM, inserted_mm=0.0, step_s=_STEP_S, elements=_ELEMENTS
    )
    controlled = run_closed_loop(setup, inputs, controller, log=controller.signals, keep_shape=True)
    run = controlled.run
    path = path_mm(run.inputs.inserted_mm, np.radians(run.tip_deg))
    return SteeredInsertion(name=name, controlled=controlled, path_mm=path)

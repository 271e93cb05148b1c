"""Steered insertions: the tip's path follows from the roll of MuJoCo's tip.

`insert_straight` repeats Figs. 11 and 12: 7 cm at 5 mm/s, a baseline curving to
either side, and four half turns with and without torsion compensation. Published:
12 mm out of the plane without, 4 mm with.

`hold_plane` puts Kallem and Cowan's planar controller on top, in three worlds: its own
simulation, in which the tip is where the base is; the twisting needle, with torsion
left out of the controller; and the twisting needle with compensation.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controllers.planar import PlanarController
from models.bevel import PREBENT_RADIUS_MM, BevelTip, path_mm
from models.materials import MATERIALS
from models.needle import NITINOL
from models.tissue import Tissue
from sim.closed_loop import Flight, Reading, fly
from sim.control.pilots import Pilot, pilot_named
from sim.control.tables import DESIGN
from sim.discretisation import Discretisation, Mesh
from sim.schedule import Schedule
from sim.spec import Setup

Array = NDArray[np.float64]

PUBLISHED_MM = {"base_only": 12.0, "feedforward": 4.0}
STEERED = ("baseline_right", "baseline_left", "base_only", "feedforward", "least_time")
_SPEED_MM_S, _LENGTH_MM, _FREE_MM = 5.0, 70.0, 120.0
_STEP_S = 0.005
_ELEMENTS = 32


@dataclass(frozen=True, kw_only=True)
class Steered:
    """An insertion and where its tip went.

    Attributes:
      name: of the controller, or of the baseline.
      flight: the run; None for a baseline, which does not turn.
      path_mm: (N, 3); z is out of the plane of the baseline.
    """

    name: str
    flight: Flight | None
    path_mm: Array

    @property
    def out_of_plane_mm(self) -> float:
        """Largest deviation from the plane of the baseline."""
        return float(np.abs(self.path_mm[:, 2]).max())


def half_turns() -> Schedule:
    """7 cm at 5 mm/s; the wish turns by 180 deg after each of the first 4 cm."""
    corners = [0.0]
    angle = [0.0]
    for turn in range(4):
        at = (turn + 1) * 10.0 / _SPEED_MM_S
        corners += [at, at + 1e-6]
        angle += [180.0 * turn, 180.0 * (turn + 1)]
    corners.append(_LENGTH_MM / _SPEED_MM_S)
    angle.append(720.0)
    time = np.array(corners)
    depth = _SPEED_MM_S * time
    return Schedule(
        time_s=time,
        drive=np.array(angle),
        free_mm=_FREE_MM - depth,
        inserted_mm=depth,
        speed_mm_s=np.full(time.size, _SPEED_MM_S),
    )


def _setup(tissue: Tissue, *, free_mm: float, inserted_mm: float) -> Setup:
    return Setup(
        needle=NITINOL,
        tissue=tissue,
        discretisation=Discretisation(step_s=_STEP_S, elements=_ELEMENTS),
        mesh=Mesh.NEEDLE,
        free_mm=free_mm,
        inserted_mm=inserted_mm,
    )


def insert_straight(tissue: Tissue = MATERIALS["viscous-plastisol"]) -> list[Steered]:
    """Every insertion of Figs. 11 and 12, and one by our fastest controller."""
    inputs = half_turns()
    arc = np.linspace(0.0, _LENGTH_MM, 701)
    found = [
        Steered(name="baseline_right", flight=None, path_mm=path_mm(arc, np.zeros(arc.size))),
        Steered(name="baseline_left", flight=None, path_mm=path_mm(arc, np.full(arc.size, np.pi))),
    ]
    for name in STEERED[2:]:
        pilot = pilot_named(name, DESIGN)
        setup = _setup(tissue, free_mm=_FREE_MM, inserted_mm=0.0)
        flight = fly(setup, inputs, pilot, keep=pilot.log, keep_shape=True)
        run = flight.run
        path = path_mm(run.inputs.inserted_mm, np.radians(run.tip_deg))
        found.append(Steered(name=name, flight=flight, path_mm=path))
    return found


class PlanarPilot:
    """The planar controller on top of a tip controller.

    Args:
      pilot: turns the base; None: the tip is where the base is wanted (no torsion).
      height_mm: where the tip starts over the plane.
    """

    def __init__(self, pilot: Pilot | None, *, height_mm: float) -> None:
        self.tip = BevelTip(PREBENT_RADIUS_MM, (0.0, 0.0, height_mm))
        self.planar = PlanarController(radius_mm=PREBENT_RADIUS_MM)
        self.pilot = pilot
        self._wish_rad, self._depth_mm = 0.0, math.nan
        self.heights_mm: list[float] = []

    @property
    def advance_mm(self) -> float:
        """No axial motion beside the schedule's."""
        return 0.0

    def __call__(self, reading: Reading, wanted_deg: float) -> float:
        """Advance the tip by what the needle went in, and wish for a new roll."""
        roll = self._wish_rad if self.pilot is None else math.radians(reading.tip_deg)
        travelled = 0.0 if math.isnan(self._depth_mm) else reading.inserted_mm - self._depth_mm
        self._depth_mm = reading.inserted_mm
        self.tip.advance(travelled, roll)
        self.heights_mm.append(float(self.tip.position_mm[2]))
        pull, onward = self.tip.pointing(self._believed_rad(reading))
        rate = self.planar.roll_rate(self.tip.position_mm[2], self.tip.tangent, pull, onward)
        self._wish_rad += rate * travelled
        wish = math.degrees(self._wish_rad)
        return wish if self.pilot is None else self.pilot(reading, wish)

    def _believed_rad(self, reading: Reading) -> float:
        """The roll that the planar controller takes the tip to have."""
        if self.pilot is None:
            return self._wish_rad
        return math.radians(self.pilot.estimated_tip_deg)


@dataclass(frozen=True, kw_only=True)
class PlaneHeld:
    """How the tip came into the plane: depth travelled, mm, and height, mm, (N,) each."""

    name: str
    travelled_mm: Array
    height_mm: Array

    def converged_mm(self, within_mm: float = 0.5) -> float:
        """Travel after which the tip stays within a height of the plane; NaN: never."""
        outside = np.flatnonzero(np.abs(self.height_mm) > within_mm)
        if outside.size == 0:
            return 0.0
        if outside[-1] + 1 == self.height_mm.size:
            return math.nan
        return float(self.travelled_mm[outside[-1] + 1])


PLANES = {
    "its own simulation": None,
    "torsion left out": "base_only_at_limit",
    "torsion compensated": "feedforward",
    "torsion compensated, regulator": "lqr",
}


def hold_plane(
    tissue: Tissue = MATERIALS["viscous-plastisol"],
    *,
    height_mm: float = 3.0,
    start_mm: float = 100.0,
    travel_mm: float = 120.0,
    speed_mm_s: float = 10.0,
) -> list[PlaneHeld]:
    """The planar controller in every world of `PLANES`."""
    time = np.array([0.0, travel_mm / speed_mm_s])
    depth = start_mm + speed_mm_s * time
    inputs = Schedule(
        time_s=time,
        drive=np.zeros(2),
        free_mm=50.0 + travel_mm - speed_mm_s * time,
        inserted_mm=depth,
        speed_mm_s=np.full(2, speed_mm_s),
    )
    found = []
    for name, controller in PLANES.items():
        inner = pilot_named(controller, DESIGN) if controller else None
        pilot = PlanarPilot(inner, height_mm=height_mm)
        setup = _setup(tissue, free_mm=50.0 + travel_mm, inserted_mm=start_mm)
        flight = fly(setup, inputs, pilot)
        travelled = flight.run.inputs.inserted_mm - start_mm
        found.append(PlaneHeld(name=name, travelled_mm=travelled, height_mm=np.array(pilot.heights_mm)))
    return found

"""Steered insertions: the path of the tip follows from the roll of MuJoCo's tip.

`steered_insertions` repeats Figs. 11 and 12: 7 cm at 5 mm/s, a baseline that curves to
either side, and four half turns with and without torsion compensation. Published:
12 mm out of the plane without, 4 mm with.

`approach_plane` closes Kallem and Cowan's planar controller around it, in three cases: a
rigid needle, whose tip is where the base is; the twisting needle, with torsion left out
of the controller; and the twisting needle with torsion compensation.
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
from sim.closed_loop import ClosedLoopRun, Measurement, run_closed_loop
from sim.discretisation import Discretisation, Mesh
from sim.schedule import Schedule
from sim.spec import Setup
from studies.control.tables import DESIGN
from studies.control.tip_controllers import TipController, tip_controller_named

Array = NDArray[np.float64]

PUBLISHED_MM = {"base_only": 12.0, "feedforward": 4.0}
STEERED = ("baseline_right", "baseline_left", "base_only", "feedforward", "least_time")
_SPEED_MM_S, _LENGTH_MM, _FREE_MM = 5.0, 70.0, 120.0
_STEP_S = 0.005
_ELEMENTS = 32


@dataclass(frozen=True, kw_only=True)
class SteeredInsertion:
    """An insertion and the path of its tip.

    Attributes:
      name: of the controller, or of the baseline.
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


def half_turns() -> Schedule:
    """7 cm at 5 mm/s; the reference steps by 180 deg after each of the first 4 cm."""
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
        mesh=Mesh.LAGRANGIAN,
        free_mm=free_mm,
        inserted_mm=inserted_mm,
    )


def steered_insertions(
    tissue: Tissue = MATERIALS["viscous-plastisol"], *, controllers: tuple[str, ...] = STEERED[2:]
) -> list[SteeredInsertion]:
    """Every insertion of Figs. 11 and 12, and one by our fastest controller."""
    inputs = half_turns()
    arc = np.linspace(0.0, _LENGTH_MM, 701)
    insertions = [
        SteeredInsertion(
            name="baseline_right", controlled=None, path_mm=path_mm(arc, np.zeros(arc.size))
        ),
        SteeredInsertion(
            name="baseline_left", controlled=None, path_mm=path_mm(arc, np.full(arc.size, np.pi))
        ),
    ]
    for name in controllers:
        controller = tip_controller_named(name, DESIGN)
        setup = _setup(tissue, free_mm=_FREE_MM, inserted_mm=0.0)
        controlled = run_closed_loop(setup, inputs, controller, log=controller.signals, keep_shape=True)
        run = controlled.run
        path = path_mm(run.inputs.inserted_mm, np.radians(run.tip_deg))
        insertions.append(SteeredInsertion(name=name, controlled=controlled, path_mm=path))
    return insertions


class CascadedPlanarController:
    """The planar controller as the outer loop of a tip controller.

    Args:
      inner: turns the base; None: a rigid needle, whose tip is where the base should be.
      height_mm: height of the tip over the plane at the start.
    """

    def __init__(self, inner: TipController | None, *, height_mm: float) -> None:
        self.tip = BevelTip(PREBENT_RADIUS_MM, (0.0, 0.0, height_mm))
        self.planar = PlanarController(radius_mm=PREBENT_RADIUS_MM)
        self.inner = inner
        self._reference_rad, self._depth_mm = 0.0, math.nan
        self.heights_mm: list[float] = []

    @property
    def advance_mm(self) -> float:
        """No axial motion beside the schedule's."""
        return 0.0

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """Advance the tip by what the needle went in, and set a new reference of its roll."""
        roll = self._reference_rad if self.inner is None else math.radians(measurement.tip_deg)
        travelled = 0.0 if math.isnan(self._depth_mm) else measurement.inserted_mm - self._depth_mm
        self._depth_mm = measurement.inserted_mm
        self.tip.advance(travelled, roll)
        self.heights_mm.append(float(self.tip.position_mm[2]))
        pull, onward = self.tip.pointing(self._estimated_rad())
        rate = self.planar.roll_rate(self.tip.position_mm[2], self.tip.tangent, pull, onward)
        self._reference_rad += rate * travelled
        roll_deg = math.degrees(self._reference_rad)
        return roll_deg if self.inner is None else self.inner(measurement, roll_deg)

    def _estimated_rad(self) -> float:
        """The roll of the tip as the planar controller knows it."""
        if self.inner is None:
            return self._reference_rad
        return math.radians(self.inner.estimated_tip_deg)


@dataclass(frozen=True, kw_only=True)
class PlaneApproach:
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


PLANAR_CASES = {
    "its own simulation": None,
    "torsion left out": "base_only_at_limit",
    "torsion compensated": "feedforward",
    "torsion compensated, regulator": "lqr",
}


def approach_plane(
    tissue: Tissue = MATERIALS["viscous-plastisol"],
    *,
    height_mm: float = 3.0,
    start_mm: float = 100.0,
    travel_mm: float = 120.0,
    speed_mm_s: float = 10.0,
    cases: tuple[str, ...] = tuple(PLANAR_CASES),
) -> list[PlaneApproach]:
    """The planar controller in each of the `PLANAR_CASES`."""
    time = np.array([0.0, travel_mm / speed_mm_s])
    depth = start_mm + speed_mm_s * time
    inputs = Schedule(
        time_s=time,
        drive=np.zeros(2),
        free_mm=50.0 + travel_mm - speed_mm_s * time,
        inserted_mm=depth,
        speed_mm_s=np.full(2, speed_mm_s),
    )
    approaches = []
    for name in cases:
        controller = PLANAR_CASES[name]
        inner = tip_controller_named(controller, DESIGN) if controller else None
        planar = CascadedPlanarController(inner, height_mm=height_mm)
        setup = _setup(tissue, free_mm=50.0 + travel_mm, inserted_mm=start_mm)
        travelled = run_closed_loop(setup, inputs, planar).run.inputs.inserted_mm - start_mm
        approaches.append(
            PlaneApproach(name=name, travelled_mm=travelled, height_mm=np.array(planar.heights_mm))
        )
    return approaches

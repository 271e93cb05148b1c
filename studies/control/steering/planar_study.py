"""The planar controller on the needle: rigid needle, torsion ignored, torsion compensated.

The needle starts 10 cm deep, 3 mm over the plane and parallel to it. In `approach_plane`
the controller knows the exact pose. In `imaged_approaches` it gets images of the height,
with noise and delay, and noisy readings at the base.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from controllers.steering.planar_observer import PlanarObserver
from models.bevel import PREBENT_RADIUS_MM
from models.materials import MATERIALS
from models.tissue import Tissue
from sim.closed_loop import Measurement, MeasurementNoise, run_closed_loop
from sim.schedule import Schedule
from studies.control.steering.camera import CAMERA, Camera, CameraModel
from studies.control.steering.insertion_setup import constant_speed, lagrangian_setup
from studies.control.steering.planar_loop import CascadedPlanarController, ImagedHeight, KnownPose
from studies.control.tables import DESIGN
from studies.control.tip_controllers import TipController, tip_controller_named

Array = NDArray[np.float64]

SPEEDS_MM_S = (2.5, 5.0, 7.5, 10.0)
PLANAR_CASES = {
    "its own simulation": None,
    "torsion left out": "base_only_at_limit",
    "torsion compensated": "feedforward",
    "torsion compensated, regulator": "lqr",
}
SEEDS = tuple(range(101, 117))  # none of those on which the settling lengths were set
WITHIN_MM = 0.5
# Set on the rigid needle with seeds 1 to 8: any faster, and the camera's noise shakes the tip.
CONTROLLER_SETTLING_MM, OBSERVER_SETTLING_MM = 15.0, 10.0
_HEIGHT_MM, _START_MM, _FREE_MM = 3.0, 100.0, 50.0
_BASE_DEG, _TORQUE_N_MM = 0.02, 0.015  # noise, as in Tables IV and V
_TRAVEL_A_STEP_MM, _LARGEST_STEP_S, _ELEMENTS = 0.1, 0.02, 24


@dataclass(frozen=True, kw_only=True)
class PlaneApproach:
    """Path of the tip into the plane: travel, mm, and height, mm, (N,) each."""

    name: str
    travelled_mm: Array
    height_mm: Array

    def converged_mm(self, within_mm: float = WITHIN_MM) -> float:
        """Travel after which the tip stays within a height of the plane; NaN: never."""
        outside = np.flatnonzero(np.abs(self.height_mm) > within_mm)
        if outside.size == 0:
            return 0.0
        if outside[-1] + 1 == self.height_mm.size:
            return math.nan
        return float(self.travelled_mm[outside[-1] + 1])

    def rms_mm(self, after_mm: float) -> float:
        """Root mean square height after a travel; NaN if the run was shorter."""
        late = self.height_mm[self.travelled_mm >= after_mm]
        return float(np.sqrt(np.mean(late**2))) if late.size else math.nan


def approach_plane(
    tissue: Tissue = MATERIALS["viscous-plastisol"],
    *,
    travel_mm: float = 120.0,
    speed_mm_s: float = 10.0,
    cases: Sequence[str] = tuple(PLANAR_CASES),
) -> list[PlaneApproach]:
    """The planar controller with known pose, in each of the `PLANAR_CASES`."""
    inputs = _inputs(travel_mm, speed_mm_s)
    return [_approach(name, _with_known_pose(name), inputs, tissue, seed=None) for name in cases]


def imaged_approaches(
    tissue: Tissue = MATERIALS["viscous-plastisol"],
    *,
    travel_mm: float = 160.0,
    speed_mm_s: float = 10.0,
    camera: CameraModel = CAMERA,
    cases: Sequence[str] = tuple(PLANAR_CASES),
    seeds: Sequence[int] = SEEDS,
) -> dict[str, list[PlaneApproach]]:
    """The planar controller with images and its observer: for each case, one approach per seed."""
    inputs = _inputs(travel_mm, speed_mm_s)
    return {
        name: [_approach(name, _imaged(name, camera, seed), inputs, tissue, seed=seed) for seed in seeds]
        for name in cases
    }


def _with_known_pose(name: str) -> CascadedPlanarController:
    return CascadedPlanarController(_inner(name), KnownPose(), height_mm=_HEIGHT_MM)


def _imaged(name: str, camera: CameraModel, seed: int) -> CascadedPlanarController:
    observer = PlanarObserver(radius_mm=PREBENT_RADIUS_MM, settling_mm=OBSERVER_SETTLING_MM)
    knowledge = ImagedHeight(Camera(camera, seed=seed), observer)
    return CascadedPlanarController(
        _inner(name), knowledge, height_mm=_HEIGHT_MM, settling_mm=CONTROLLER_SETTLING_MM
    )


def _inner(name: str) -> TipController | None:
    """The tip controller of a case, in its initial state."""
    controller = PLANAR_CASES[name]
    return _fresh(controller) if controller else None


def _fresh(controller: str) -> TipController:
    made = _designed(controller)
    made.reset()
    return made


@cache
def _designed(controller: str) -> TipController:
    """The tip controller of a case, cached: a regulator's gains over all depths take a second."""
    return tip_controller_named(controller, DESIGN)


def _inputs(travel_mm: float, speed_mm_s: float) -> Schedule:
    return constant_speed(
        start_mm=_START_MM, travel_mm=travel_mm, speed_mm_s=speed_mm_s, free_mm=_FREE_MM
    )


def _approach(
    name: str,
    planar: CascadedPlanarController,
    inputs: Schedule,
    tissue: Tissue,
    *,
    seed: int | None,
) -> PlaneApproach:
    """One run; None as seed: no noise."""
    step_s = min(_TRAVEL_A_STEP_MM / float(inputs.speed_mm_s[0]), _LARGEST_STEP_S)
    if planar.inner is None:
        depth = _run_rigid(planar, inputs.at_steps(step_s))
    else:
        setup = lagrangian_setup(
            tissue,
            free_mm=float(inputs.free_mm[0]),
            inserted_mm=_START_MM,
            step_s=step_s,
            elements=_ELEMENTS,
        )
        noise = MeasurementNoise(base_deg=_BASE_DEG, torque_n_mm=_TORQUE_N_MM, seed=seed or 0)
        controlled = run_closed_loop(setup, inputs, planar, noise=noise if seed else None)
        depth = controlled.run.inputs.inserted_mm
    return PlaneApproach(
        name=name, travelled_mm=depth - _START_MM, height_mm=np.array(planar.heights_mm)
    )


def _run_rigid(planar: CascadedPlanarController, inputs: Schedule) -> Array:
    """The planar controller's own simulation: no torsion, so no needle; the depth, mm, (N,)."""
    base_deg = 0.0
    for time_s, inserted_mm, free_mm in zip(
        inputs.time_s, inputs.inserted_mm, inputs.free_mm, strict=True
    ):
        measured = Measurement(
            time_s=float(time_s),
            base_deg=base_deg,
            torque_n_mm=0.0,
            tip_deg=base_deg,
            inserted_mm=float(inserted_mm),
            free_mm=float(free_mm),
        )
        base_deg = planar(measured, 0.0)
    return inputs.inserted_mm

"""The planar controller around a tip controller: its roll becomes the reference of the tip.

What it knows of the tip comes either with the pose (`KnownPose`), or from a camera that sees
the height alone, through the observer (`ImagedHeight`). Either is told how far the tip
rolled: as the base, where torsion is left out of the controller, or as the torsion
estimator says.
"""

import math
from typing import Protocol

from controllers.steering.planar import PlanarController, PlanarState
from controllers.steering.planar_observer import PlanarObserver
from models.bevel import PREBENT_RADIUS_MM, BevelTip
from sim.closed_loop import Measurement
from studies.control.steering.camera import Camera
from studies.control.tip_controllers import TipController


class PlanarKnowledge(Protocol):
    """Where the controller takes its state from."""

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """The state after a travel.

        Args:
          tip: the true one.
          roll_rad: of the tip, as the controller knows it.
        """


class KnownPose:
    """Height and direction are known exactly; the roll is as the controller knows it."""

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """Read off the tip."""
        toward, onward = tip.pointing(roll_rad)
        return PlanarState(
            float(tip.position_mm[2]), float(tip.tangent[2]), float(toward[2]), float(onward[2])
        )


class ImagedHeight:
    """Images of the height, and the observer for the rest."""

    def __init__(self, camera: Camera, observer: PlanarObserver) -> None:
        self.camera, self.observer = camera, observer
        self._roll_rad = 0.0

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """Predict, and correct where an image arrives."""
        self.observer.advance(travel_mm, roll_rad - self._roll_rad)
        self._roll_rad = roll_rad
        view = self.camera.look(time_s, tip.position_mm[2:])
        if view.position_mm is not None:
            self.observer.see(float(view.position_mm[0]))
        if view.exposes:
            self.observer.expose()
        return self.observer.state


class CascadedPlanarController:
    """The planar controller as the outer loop of a tip controller.

    Args:
      inner: turns the base; None: a rigid needle, whose tip is where the base should be.
      knowledge: of the tip.
      height_mm: height of the tip over the plane at the start.
    """

    def __init__(
        self,
        inner: TipController | None,
        knowledge: PlanarKnowledge,
        *,
        height_mm: float,
        settling_mm: float = 10.0,
    ) -> None:
        self.tip = BevelTip(PREBENT_RADIUS_MM, (0.0, 0.0, height_mm))
        self.planar = PlanarController(radius_mm=PREBENT_RADIUS_MM, settling_mm=settling_mm)
        self.inner, self.knowledge = inner, knowledge
        self._reference_rad, self._depth_mm = 0.0, math.nan
        self.heights_mm: list[float] = []

    @property
    def advance_mm(self) -> float:
        """No axial motion beside the schedule's."""
        return 0.0

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """Advance the tip by what the needle went in, and set a new reference of its roll."""
        travel = 0.0 if math.isnan(self._depth_mm) else measurement.inserted_mm - self._depth_mm
        self._depth_mm = measurement.inserted_mm
        self.tip.advance(travel, self._true_roll_rad(measurement))
        self.heights_mm.append(float(self.tip.position_mm[2]))
        state = self.knowledge.update(self.tip, measurement.time_s, travel, self._known_roll_rad())
        self._reference_rad += self.planar.roll_rate(state) * travel
        roll_deg = math.degrees(self._reference_rad)
        return roll_deg if self.inner is None else self.inner(measurement, roll_deg)

    def _true_roll_rad(self, measurement: Measurement) -> float:
        return self._reference_rad if self.inner is None else math.radians(measurement.tip_deg)

    def _known_roll_rad(self) -> float:
        """The roll of the tip as the planar controller knows it."""
        if self.inner is None:
            return self._reference_rad
        return math.radians(self.inner.estimated_tip_deg)

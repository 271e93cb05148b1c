"""The planar controller around a tip controller: its roll becomes the reference of the tip.

Its state comes either from the exact pose (`KnownPose`), or from a camera that sees only
the height, by the observer (`ImagedHeight`). Both also get the roll of the tip: that of the
base if the controller ignores torsion, else that of the torsion estimator.
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
    """The source of the controller's state."""

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """The state after a travel.

        Args:
          tip: the true pose of the tip.
          roll_rad: roll of the tip, as the controller knows it.
        """


class KnownPose:
    """Height and direction are known exactly; the roll is as the controller knows it."""

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """The state from the true pose."""
        toward, onward = tip.pointing(roll_rad)
        return PlanarState(
            float(tip.position_mm[2]), float(tip.tangent[2]), float(toward[2]), float(onward[2])
        )


class ImagedHeight:
    """The height from images, slope and roll from the observer."""

    def __init__(self, camera: Camera, observer: PlanarObserver) -> None:
        self.camera, self.observer = camera, observer
        self._roll_rad = 0.0

    def update(self, tip: BevelTip, time_s: float, travel_mm: float, roll_rad: float) -> PlanarState:
        """Predict the state; correct it if an image arrives."""
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
      inner: controller that turns the base; None: a rigid needle, whose tip turns with the base.
      knowledge: source of the state.
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
        """0: no axial motion in addition to the scheduled one."""
        return 0.0

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """Advance the tip by the travel of the needle, and set a new reference of its roll."""
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

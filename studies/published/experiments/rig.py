"""The published rig: what the paper states of it, and what a candidate changes.

Stated are the needle, the viscous law with b = 3.45 N mm s at 200 mm, and a base that
starts 5 cm from the tissue. Not stated is how the base turns: "quickly", "tuned to
provide the fastest response without oscillating". Two motions stand for that:

    ramp     90 deg at a constant rate in some time; 0.3 s wherever this project has to choose
    servo    a critically damped servo of second order, 1 - (1 + t / T) exp(-t / T)

"Stated" has two readings of the free length: the set-up's 50 mm, and none, which is
the model of Sections III and V.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import NDArray

from diagnosis.rig_log import Rig
from diagnosis.rig_model import RigModel
from models import published

Array = NDArray[np.float64]

TURN_DEG = 90.0
SETUP_FREE_MM = 50.0

_STATED: dict[str, Any] = {
    "format": "rig-log/1",
    "needle": {
        "diameter_mm": published.NEEDLE_DIAMETER.value,
        "shear_modulus_gpa": published.NEEDLE_SHEAR_MODULUS.value,
        "density_g_cm3": published.NEEDLE_DENSITY.value,
    },
    "tissue": {"damping_n_mm_s_per_mm": published.DAMPING_200_MM.value / 200},
    "sensors": {
        "tip_angle_noise_deg": 0.6,  # the Hall sensor's resolution (Section II-A)
        "base_torque_noise_n_mm": 0.0,
        "base_angle_noise_deg": 0.0,
    },
    "trials": [{"file": "published"}],
}
STATED = Rig(**_STATED)


class Shape(StrEnum):
    """How the base comes to 90 deg."""

    RAMP = "ramp"
    SERVO = "servo"


@dataclass(frozen=True, kw_only=True)
class BaseMotion:
    """The base's own motion: shape, and its time (a ramp's duration, a servo's T), s."""

    shape: Shape = Shape.RAMP
    time_s: float = 0.3

    def angle_deg(self, time_s: Array) -> Array:
        """Base angle at times from the start of the turn, deg, (N,)."""
        share = time_s / self.time_s
        if self.shape is Shape.RAMP:
            return np.asarray(TURN_DEG * np.clip(share, 0.0, 1.0), np.float64)
        return np.asarray(TURN_DEG * (1 - (1 + share) * np.exp(-share)), np.float64)


@dataclass(frozen=True, kw_only=True)
class PaperRig:
    """A candidate for the published rig; as constructed it is the stated one.

    Attributes:
      model: needle, tissue, drive and sensors, as the diagnosis of rig logs has them.
      free_mm: between base and tissue as the quick turn begins; 0: none at any time.
      motion: of the base in the quick turn.
    """

    model: RigModel = RigModel()  # noqa: RUF009 - frozen
    free_mm: float = SETUP_FREE_MM
    motion: BaseMotion = BaseMotion()

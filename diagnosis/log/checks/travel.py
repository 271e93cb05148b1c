"""Axial travel of a needle, from its logged speed."""

import numpy as np
from numpy.typing import NDArray

from diagnosis.log.trial import Trial

Array = NDArray[np.float64]


def travelled_mm(trial: Trial) -> Array:
    """Axial travel into the tissue since the start, from the speed, mm."""
    speed = trial["speed_mm_s"]
    parts = np.diff(trial["time_s"]) * (speed[1:] + speed[:-1]) / 2
    return np.concatenate(([0.0], np.cumsum(parts)))

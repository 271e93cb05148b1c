"""Inputs and outputs of estimators and controllers at each sample.

Outputs are never NaN: after an unusable sample the last good output is held, and the status
says so.
"""

import math
from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Status(StrEnum):
    """How an output was obtained."""

    OK = "ok"
    OUTSIDE = "outside"
    """The needle is not in tissue: the tip is where the base is."""
    BAD_SAMPLE = "bad sample"
    """A NaN or an impossible length: the last output is held."""
    BAD_TIME = "bad time"
    """Time stood still or went back: the last output is held."""
    DIVERGED = "diverged"
    """The estimate is not finite; reset before going on."""


@dataclass(frozen=True, slots=True)
class Sample:
    """One sample of a rig at its base.

    Attributes:
      time_s: increasing from sample to sample.
      base_deg: measured angle of the base.
      torque_n_mm: measured torque that the drive puts in.
      inserted_mm, free_mm: lengths in tissue, and between chuck and tissue.
      tip_deg: measured angle of the tip; None without such a sensor.
    """

    time_s: float
    base_deg: float
    torque_n_mm: float
    inserted_mm: float
    free_mm: float
    tip_deg: float | None = None

    def usable(self) -> bool:
        """Whether every number is finite and every length possible."""
        isfinite = math.isfinite
        return (
            isfinite(self.time_s)
            and isfinite(self.base_deg)
            and isfinite(self.torque_n_mm)
            and (self.tip_deg is None or isfinite(self.tip_deg))
            and 0 <= self.inserted_mm < math.inf
            and 0 <= self.free_mm < math.inf
        )


@dataclass(frozen=True, slots=True)
class Estimate:
    """What an estimator computes from the samples so far.

    Attributes:
      tip_deg: angle of the tip.
      modes_deg: amplitudes of modes 1, 2, ... of the shaft's twist.
      damping_n_mm_s_per_mm: beta of the model at this sample.
      status: how the estimate came about.
    """

    tip_deg: float
    modes_deg: Array = field(default_factory=lambda: np.zeros(0))
    damping_n_mm_s_per_mm: float = math.nan
    status: Status = Status.OK


@dataclass(frozen=True, slots=True)
class Command:
    """The command to the base until the next sample.

    Attributes:
      base_deg: commanded angle.
      rate_limited, torque_limited: which limits reduced it.
      advance_mm: axial motion relative to the planned one (retraction, dither).
      status: status of the estimate that it was computed from.
    """

    base_deg: float
    rate_limited: bool = False
    torque_limited: bool = False
    advance_mm: float = 0.0
    status: Status = Status.OK

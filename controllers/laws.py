"""Control laws: a base command from a reference of the tip angle and an estimate of it.

    base only      base = reference
    compensator    base = reference + gain (reference - tip_hat)       the paper's overshoot

Each law computes a base angle; `LimitedBase` saturates it at the limits of the motor. Other laws:
controllers.regulator, controllers.least_time (plans), controllers.friction (winds).
"""

import math
from typing import Protocol

from controllers.limits import LimitedBase, MotorLimits
from controllers.signals import Command, Estimate, Sample
from models.errors import InvalidValue


class Controller(Protocol):
    """Computes a base command from a reference of the tip, deg, and an estimate of it."""

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """The base command until the next sample."""

    def reset(self) -> None:
        """Go back to the initial state, for a new run."""


class BaseOnly:
    """Turns the base to the reference, as if the needle were rigid."""

    def __init__(self, limits: MotorLimits) -> None:
        self._base = LimitedBase(limits)

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """base = reference."""
        return self._base.toward(reference_deg, sample, estimate.status)


class Compensator:
    """The paper's torsion compensator: the base overshoots by the error of the tip.

    Args:
      gain: overshoot / estimated error of the tip.

    Raises:
      InvalidValue: gain is negative.
    """

    def __init__(self, limits: MotorLimits, *, gain: float = 1.0) -> None:
        if not (math.isfinite(gain) and gain >= 0):
            raise InvalidValue("gain", gain, "a finite number of at least 0")
        self._base, self.gain = LimitedBase(limits), gain

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """base = reference + gain (reference - tip)."""
        target_deg = reference_deg + self.gain * (reference_deg - estimate.tip_deg)
        return self._base.toward(target_deg, sample, estimate.status)

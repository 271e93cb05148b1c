"""Controllers of the tip: from a reference of the tip and an estimate to a base command.

    base only      base = reference
    compensator    base = reference + gain (reference - tip_hat)       the paper's overshoot

Each law gives a base angle; `LimitedBase` saturates it to the limits of the motor. The regulator
is in controllers.regulator, those that plan or wind in controllers.least_time and .friction.
"""

import math
from typing import Protocol

from controllers.limits import LimitedBase, MotorLimits
from controllers.signals import Command, Estimate, Sample
from models.errors import InvalidValue


class Controller(Protocol):
    """Anything that turns a reference of the tip, deg, and an estimate into a base command."""

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """The command until the next sample."""

    def reset(self) -> None:
        """Forget everything before a new run."""


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
      gain: overshoot over the estimated error of the tip.

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

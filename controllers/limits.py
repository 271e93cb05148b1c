"""Limits of the motor, and the saturation of base commands to them."""

import math

from controllers.signals import Command, Estimate, Sample, Status
from models.needle import Positive
from models.record import Record


class MotorLimits(Record):
    """Limits of the motor at the base.

    The rate is that of the commanded angle. Torque cannot be commanded where the base
    is a servo: at the limit, the base goes no further against the torque it feels.
    """

    rate_deg_s: Positive = 1500.0
    torque_n_mm: Positive = 20.0


class LimitedBase:
    """Saturates base angles to commands that the motor can follow."""

    def __init__(self, limits: MotorLimits) -> None:
        self.limits = limits
        self.reset()

    def reset(self) -> None:
        """Forget the last command: the next starts from the measured base."""
        self._base_deg = math.nan
        self._time_s = math.nan

    @property
    def base_deg(self) -> float:
        """The last command, deg; NaN before the first."""
        return self._base_deg

    def toward(
        self, target_deg: float, sample: Sample, status: Status, advance_mm: float = 0.0
    ) -> Command:
        """The nearest command to a base angle that the limits allow.

        An unusable sample, or an angle that is not finite, holds the base.
        """
        usable = status in (Status.OK, Status.OUTSIDE) and math.isfinite(target_deg)
        if not usable:
            held = self._base_deg if math.isfinite(self._base_deg) else sample.base_deg
            return Command(held, status=status if status is not Status.OK else Status.BAD_SAMPLE)
        if not math.isfinite(self._base_deg):
            self._base_deg, self._time_s = sample.base_deg, sample.time_s
        reach = self.limits.rate_deg_s * max(sample.time_s - self._time_s, 0.0)
        self._time_s = sample.time_s
        change = target_deg - self._base_deg
        rate_limited = abs(change) > reach
        change = min(max(change, -reach), reach)
        against = change * sample.torque_n_mm > 0
        torque_limited = against and abs(sample.torque_n_mm) >= self.limits.torque_n_mm
        if not torque_limited:
            self._base_deg += change
        return Command(self._base_deg, rate_limited, torque_limited, advance_mm, status)


def rigid_needle_estimate(sample: Sample) -> Estimate:
    """The estimate without torsion: the tip is where the base is."""
    return Estimate(sample.base_deg)

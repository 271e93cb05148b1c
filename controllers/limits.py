"""Limits of the motor and of the shaft, and the saturation of base commands to them.

A turn of the base by du within a time h twists the free shaft f and that part of the inserted
shaft which the turn can reach in h; the rest has not moved yet. With D = kappa / beta, the
diffusivity of (9) without inertia, a ramp over h reaches sqrt(pi D h) / 2. The expected torque is

    T + k du,     k = kappa / (f + sqrt(pi D h) / 2),

with the measured torque T. It is an upper estimate, since T has begun to decay. du is the turn that
T does not show yet: that of this sample and, if the torque reading is late, all turns that were
commanded in the meantime. The command stops where the expected torque reaches the limit.
"""

import math
from collections import deque

from controllers.signals import Command, Estimate, Sample, Status
from models.needle import Needle, NonNegative, Positive
from models.record import Record

_RAD = math.pi / 180.0


class ShaftLimits(Record):
    """The shear stress that a shaft may carry, and the constants that predict it.

    The paper states no admissible stress for its wire. This project's studies assume
    `SUPERELASTIC_SHEAR_MPA`, a value for superelastic Nitinol.
    """

    needle: Needle
    damping_n_mm_s_per_mm: Positive
    shear_stress_mpa: Positive
    lateness_s: NonNegative = 0.0
    """Delay from a command to the sample that shows its torque, in addition to one sampling step."""

    @property
    def torque_n_mm(self) -> float:
        """The torque at which the stress at the shaft's surface reaches the limit."""
        return self.needle.torque_n_mm_at(self.shear_stress_mpa)

    def stiffness_n_mm_per_deg(self, free_mm: float, turn_s: float) -> float:
        """k of the module's docstring, for a turn of some duration."""
        kappa = self.needle.rigidity_n_mm2
        reach_mm = 0.5 * math.sqrt(math.pi * kappa / self.damping_n_mm_s_per_mm * turn_s)
        return kappa / (free_mm + reach_mm) * _RAD


# An assumption, not the paper's: superelastic wire is linear up to its upper plateau strength (as
# ASTM F2516 measures it in tension), of which 400 MPa at room temperature is a cautious value;
# von Mises' criterion makes it 400 / sqrt(3) in shear. Beyond it the shaft transforms, and
# equation (1) no longer holds.
SUPERELASTIC_SHEAR_MPA = 230.0


class MotorLimits(Record):
    """Limits of the motor at the base, and of the shaft that it turns.

    The rate limit applies to the commanded angle. A servo takes no torque command: at the torque
    limit, the base does not turn any further against the torque.
    """

    rate_deg_s: Positive = 1500.0
    torque_n_mm: Positive = 20.0
    shaft: ShaftLimits | None = None
    """None: the shaft may carry whatever the motor gives."""

    @property
    def most_torque_n_mm(self) -> float:
        """The smaller of the limits of motor and shaft."""
        return min(self.torque_n_mm, self.shaft.torque_n_mm if self.shaft else math.inf)


class LimitedBase:
    """Saturates base angles to commands that motor and shaft can follow."""

    def __init__(self, limits: MotorLimits) -> None:
        self.limits = limits
        self.reset()

    def reset(self) -> None:
        """Forget the last command: the next starts from the measured base."""
        self._base_deg = math.nan
        self._time_s = math.nan
        self._sent: deque[tuple[float, float]] = deque()

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
        passed_s = max(sample.time_s - self._time_s, 0.0)
        reach = self.limits.rate_deg_s * passed_s
        self._time_s = sample.time_s
        change = target_deg - self._base_deg
        rate_limited = abs(change) > reach
        change = min(max(change, -reach), reach)
        allowed = self._within_torque(change, sample, passed_s)
        self._base_deg += allowed
        if self.limits.shaft is not None:
            self._sent.append((sample.time_s, self._base_deg))
        return Command(self._base_deg, rate_limited, allowed != change, advance_mm, status)

    def _within_torque(self, change_deg: float, sample: Sample, passed_s: float) -> float:
        """The part of a change that keeps the torque within the limits, deg."""
        if (
            change_deg * sample.torque_n_mm > 0
            and abs(sample.torque_n_mm) >= self.limits.most_torque_n_mm
        ):
            return 0.0
        shaft = self.limits.shaft
        if shaft is None or change_deg == 0:
            return change_deg
        side = math.copysign(1.0, change_deg)
        spare_n_mm = shaft.torque_n_mm - side * sample.torque_n_mm
        stiffness = shaft.stiffness_n_mm_per_deg(sample.free_mm, passed_s + shaft.lateness_s)
        most = spare_n_mm / stiffness - side * self._unseen_deg(sample.time_s - shaft.lateness_s)
        return side * min(abs(change_deg), max(most, 0.0))

    def _unseen_deg(self, seen_s: float) -> float:
        """Change of the command since a time, deg."""
        while len(self._sent) > 1 and self._sent[1][0] <= seen_s:
            self._sent.popleft()
        return self._base_deg - self._sent[0][1] if self._sent else 0.0


def rigid_needle_estimate(sample: Sample) -> Estimate:
    """The estimate for a rigid needle: the tip has the angle of the base."""
    return Estimate(sample.base_deg)

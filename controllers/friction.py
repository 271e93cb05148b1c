"""A controller for dry friction: overshoot, hold, unwind; retract if that is not enough.

Dry friction holds a lag that no waiting removes. The base therefore

1. overshoots by the compensator's law, and keeps winding at a rate proportional to the
   tip error, until the estimate is within `dead_band` of the reference;
2. then unwinds half of the remaining lag. The tip stays where it is, since a reversal first has
   to unwind the shaft from the base on; and the torque that a later slip could release is halved;
3. asks for a short retraction and reinsertion if it can wind no further (winding at its limit,
   or torque at its limit for `rest_s`): axial sliding frees a stuck shaft (Section II-B3).

In viscous tissue no lag is held: a lag that still falls while the base rests is not unwound.
Phases end by the mean error of about the last 50 ms, so that noise alone cannot end one.
"""

import math
from enum import StrEnum

from controllers.limits import LimitedBase, MotorLimits
from controllers.signals import Command, Estimate, Sample, Status
from models.errors import InvalidValue

_UNWOUND = 0.5  # share of the held lag that is unwound
_HELD_LAG_DEG = 2.0  # a lag below this is not worth unwinding
_FALLING = 0.2  # share of its lag that tissue which holds nothing loses while the base rests
_SMOOTHING_S = 0.05


class Phase(StrEnum):
    """Phase of the controller."""

    WINDING = "winding"
    RESTING = "resting"
    UNWINDING = "unwinding"
    RETRACTING = "retracting"


class FrictionAware:
    """The controller for dry friction; the module describes its phases.

    Args:
      gain: overshoot / estimated error of the tip.
      winding_per_s: rate of further winding / tip error.
      dead_band_deg: tip error that is accepted.
      most_winding_deg: how far beyond the compensator's law the base may wind.
      rest_s: time for which the tip has to stay within the dead band before the base unwinds,
        or the torque at its limit before the needle is retracted.
      retract_mm: length of a retraction; 0: never ask for one.

    Raises:
      InvalidValue: one of them is not positive (gain and retraction may be 0).
    """

    def __init__(
        self,
        limits: MotorLimits,
        *,
        gain: float = 1.5,
        winding_per_s: float = 4.0,
        dead_band_deg: float = 0.5,
        most_winding_deg: float = 120.0,
        rest_s: float = 0.5,
        retract_mm: float = 5.0,
    ) -> None:
        for name, value, least in (
            ("gain", gain, 0.0),
            ("winding_per_s", winding_per_s, 1e-9),
            ("dead_band_deg", dead_band_deg, 1e-9),
            ("most_winding_deg", most_winding_deg, 1e-9),
            ("rest_s", rest_s, 1e-9),
            ("retract_mm", retract_mm, 0.0),
        ):
            if not (math.isfinite(value) and value >= least):
                raise InvalidValue(
                    name,
                    value,
                    "a finite number of at least 0" if least == 0 else "a finite number above 0",
                )
        self._base, self.gain, self.winding_per_s = LimitedBase(limits), gain, winding_per_s
        self.dead_band_deg, self.most_winding_deg = dead_band_deg, most_winding_deg
        self.rest_s, self.retract_mm = rest_s, retract_mm
        self.reset()

    def reset(self) -> None:
        """Start again: no winding, first phase."""
        self._base.reset()
        self.phase = Phase.WINDING
        self._wound_deg = self._at_limit_s = 0.0
        self._rest_deg = self._held_deg = 0.0
        self._mean_error_deg = math.nan
        self._reference_deg = math.nan
        self._time_s = self._since_s = math.nan

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """Wind, rest, unwind or ask for a retraction."""
        if estimate.status not in (Status.OK, Status.OUTSIDE) or not math.isfinite(reference_deg):
            return self._base.toward(reference_deg, sample, estimate.status)
        if reference_deg != self._reference_deg:
            self._reference_deg, self._wound_deg = reference_deg, 0.0
            self._mean_error_deg = math.nan
            self._enter(Phase.WINDING, sample)
        dt = sample.time_s - self._time_s if math.isfinite(self._time_s) else 0.0
        self._time_s = sample.time_s
        error_deg = reference_deg - estimate.tip_deg
        self._smooth(error_deg, dt)
        if self.phase is Phase.WINDING:
            return self._wind(reference_deg, error_deg, dt, sample, estimate)
        if self.phase is Phase.RETRACTING:
            return self._retract(reference_deg, sample, estimate)
        return self._rest(sample, estimate)

    def _smooth(self, error_deg: float, dt: float) -> None:
        if math.isnan(self._mean_error_deg):
            self._mean_error_deg = error_deg
        self._mean_error_deg -= math.expm1(-dt / _SMOOTHING_S) * (error_deg - self._mean_error_deg)

    @property
    def _lag_deg(self) -> float:
        """Lag of the tip behind the base, from the mean error, deg."""
        return self._base.base_deg - (self._reference_deg - self._mean_error_deg)

    def _enter(self, phase: Phase, sample: Sample) -> None:
        self.phase, self._since_s, self._at_limit_s = phase, sample.time_s, 0.0
        self._held_deg = self._lag_deg

    def _wind(
        self, reference_deg: float, error_deg: float, dt: float, sample: Sample, estimate: Estimate
    ) -> Command:
        if abs(self._mean_error_deg) <= self.dead_band_deg:
            self._rest_deg = self._base.base_deg
            self._enter(Phase.RESTING, sample)
            return self._base.toward(self._rest_deg, sample, estimate.status)
        near = abs(self._mean_error_deg) < 10 * self.dead_band_deg
        if near:
            self._wound_deg += self.winding_per_s * error_deg * dt
        command = self._base.toward(
            reference_deg + self.gain * error_deg + self._wound_deg, sample, estimate.status
        )
        self._at_limit_s = self._at_limit_s + dt if command.torque_limited else 0.0
        spent = self._at_limit_s >= self.rest_s or abs(self._wound_deg) >= self.most_winding_deg
        if spent and self.retract_mm > 0:
            self._enter(Phase.RETRACTING, sample)
        return command

    def _rest(self, sample: Sample, estimate: Estimate) -> Command:
        # Unwound, the torque no longer tells the lag that friction holds: the base waits
        # for the next reference and ignores the estimate.
        if self.phase is Phase.UNWINDING:
            return self._base.toward(self._rest_deg, sample, estimate.status)
        if abs(self._mean_error_deg) > 3 * self.dead_band_deg:
            # What has been wound so far is kept: the base goes on from where it is.
            self._wound_deg = (
                self._base.base_deg - self._reference_deg - self.gain * self._mean_error_deg
            )
            self._enter(Phase.WINDING, sample)
        elif sample.time_s - self._since_s >= self.rest_s:
            self._unwind(sample)
        return self._base.toward(self._rest_deg, sample, estimate.status)

    def _unwind(self, sample: Sample) -> None:
        """Unwind half of a lag that stays; wait while it still falls."""
        lag = self._lag_deg
        if abs(lag) > _HELD_LAG_DEG and abs(lag) < (1 - _FALLING) * abs(self._held_deg):
            self._enter(Phase.RESTING, sample)
            return
        if abs(lag) > _HELD_LAG_DEG:
            self._rest_deg -= _UNWOUND * lag
        self._enter(Phase.UNWINDING, sample)

    def _retract(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """Retract for a second, reinsert for a second, with the base at the reference."""
        passed = sample.time_s - self._since_s
        if passed >= 2.0:
            self._wound_deg = 0.0
            self._enter(Phase.WINDING, sample)
        advance = -self.retract_mm * min(passed, max(2.0 - passed, 0.0))
        return self._base.toward(reference_deg, sample, estimate.status, advance)

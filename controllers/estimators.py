"""Estimators of the tip: feedforward (31) and Luenberger observer (32).

Both run the modal model on the measured base torque. The feedforward estimator
does only this; the observer has a tip sensor, by which it corrects the odd
modes, so that its poles are `speed` times faster than the needle's:

    dx/dt = A x + B u + L (y - y_hat),   poles of A - L C = speed * poles of A

OutputEquation.SERIES computes base and tip from the series (12). OutputEquation.PAPER follows
the paper: mode 0 is the measured base angle, and the tip is base + sum p_k.
"""

import math
from enum import StrEnum
from typing import Protocol

import control
import numpy as np
from numpy.typing import NDArray
from scipy.special import exprel

from controllers.signals import Estimate, Sample, Status
from controllers.twist import Twist
from models.errors import InvalidValue
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_LEAST_DEPTH_MM = 1.0  # below this the needle counts as outside
_SERIES = 1e-5  # |z| below which a response is computed from its series


class OutputEquation(StrEnum):
    """How base and tip angle follow from the modes: by the series (12), or as in the paper."""

    SERIES = "series"
    PAPER = "paper"


class Estimator(Protocol):
    """Anything that turns samples into estimates."""

    def update(self, sample: Sample) -> Estimate:
        """Take one sample; times must increase."""

    def reset(self) -> None:
        """Go back to the state before the first sample: an untwisted shaft."""


class FeedforwardEstimator:
    """The modal model run on base angle and base torque (31).

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: beta.
      order: modes with mode 0.
      output: how base and tip follow from the modes.

    Raises:
      InvalidValue: damping is not positive, or the order is below 2.
    """

    def __init__(
        self,
        needle: Needle,
        *,
        damping_n_mm_s_per_mm: float,
        order: int = 4,
        output: OutputEquation = OutputEquation.SERIES,
    ) -> None:
        if not (math.isfinite(damping_n_mm_s_per_mm) and damping_n_mm_s_per_mm > 0):
            raise InvalidValue("damping_n_mm_s_per_mm", damping_n_mm_s_per_mm, "a finite number above 0")
        self.twist = Twist(needle, order)
        self.damping = damping_n_mm_s_per_mm
        self.output = output
        self.reset()

    def reset(self) -> None:
        """Go back to the state before the first sample: an untwisted shaft."""
        self._p = np.zeros(self.twist.k.size)
        self._decay = np.ones(self.twist.k.size)  # over the last sample
        self._last: Sample | None = None
        self._estimate = Estimate(tip_deg=math.nan, status=Status.BAD_SAMPLE)

    def update(self, sample: Sample) -> Estimate:
        """Take one sample; the first starts from an untwisted shaft."""
        refusal = self._refusal(sample)
        if refusal is not None:
            last = self._estimate
            return Estimate(last.tip_deg, last.modes_deg, last.damping_n_mm_s_per_mm, refusal)
        if sample.inserted_mm < _LEAST_DEPTH_MM:
            self._p[:] = 0.0
            self._estimate = self._outside(sample)
        else:
            if self._last is not None and self._last.inserted_mm >= _LEAST_DEPTH_MM:
                self._advance(self._last, sample)
            self._estimate = self._read(sample)
        self._last = sample
        if not math.isfinite(self._estimate.tip_deg):
            return Estimate(math.nan, self._estimate.modes_deg, self.damping, Status.DIVERGED)
        return self._estimate

    def _refusal(self, sample: Sample) -> Status | None:
        if not sample.usable():
            return Status.BAD_SAMPLE
        if self._last is not None and sample.time_s <= self._last.time_s:
            return Status.BAD_TIME
        return None

    def _outside(self, sample: Sample) -> Estimate:
        modes = np.zeros(self.twist.k.size)
        return Estimate(sample.base_deg, modes, self.damping, Status.OUTSIDE)

    def _advance(self, last: Sample, now: Sample) -> None:
        """Advance the modes by one sample: exact for a torque that is linear in time."""
        dt, depth = now.time_s - last.time_s, 0.5 * (last.inserted_mm + now.inserted_mm)
        growth = (now.inserted_mm - last.inserted_mm) / depth
        if growth != 0.0:
            self._p -= growth * (self.twist.stretch @ self._p)
        z = self.twist.poles(depth, self.damping) * dt
        gain = 2 * dt / (depth * self.damping) * self.twist.sign
        whole, ramp = _response(z)
        self._decay = np.exp(z)
        self._p *= self._decay
        self._p += gain * (whole * last.torque_n_mm + ramp * (now.torque_n_mm - last.torque_n_mm))

    def _read(self, sample: Sample) -> Estimate:
        tip = sample.base_deg + self._tip_past_base_rad(sample) / _RAD
        return Estimate(tip, self._p / _RAD, self.damping)

    def _tip_past_base_rad(self, sample: Sample) -> float:
        if self.output is OutputEquation.PAPER:
            return float(self._p.sum())
        free = -sample.torque_n_mm * sample.free_mm / self.twist.kappa
        tail = self.twist.tail_rad(sample.torque_n_mm, sample.inserted_mm)
        return free + tail + float(self.twist.lag_weights @ self._p)


def _response(z: Array) -> tuple[Array, Array]:
    """(e^z - 1)/z and (e^z - 1 - z)/z^2, z < 0: responses of a pole to a step and a ramp over a sample.

    Their errors are below 1e-10: near 0 the second is a series, elsewhere its rounding is 2e-16 / z.
    """
    whole: Array = exprel(z)
    ramp = np.where(z > -_SERIES, 0.5 + z / 6, (whole - 1) / np.minimum(z, -_SERIES))
    return whole, ramp


class LuenbergerEstimator(FeedforwardEstimator):
    """The observer (32): the feedforward estimator, corrected by a tip sensor.

    Args:
      speed: how many times faster than the needle the observer's poles are.

    Raises:
      InvalidValue: speed is not above 1; at 1 the observer would correct nothing.
    """

    def __init__(
        self,
        needle: Needle,
        *,
        damping_n_mm_s_per_mm: float,
        order: int = 4,
        output: OutputEquation = OutputEquation.SERIES,
        speed: float = 5.0,
    ) -> None:
        if not (math.isfinite(speed) and speed > 1):
            raise InvalidValue("speed", speed, "a finite number above 1")
        super().__init__(needle, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm, order=order, output=output)
        # Only odd modes enter the lag, and so can be corrected from it; in the paper's
        # output equation all do. Poles scale with 1 / depth^2, and so does the gain.
        self._observed = (
            self.twist.odd if output is OutputEquation.SERIES else np.ones_like(self.twist.odd)
        )
        weight = 2.0 if output is OutputEquation.SERIES else 1.0
        self._row = weight * np.ones((1, int(self._observed.sum())))
        a = -np.diag(self.twist.squares[self._observed])
        self._unit_gain = np.asarray(control.place(a.T, self._row.T, speed * np.diag(a))).T
        self._identity = np.eye(a.shape[0])

    def _advance(self, last: Sample, now: Sample) -> None:
        super()._advance(last, now)
        if now.tip_deg is None:
            return
        scale = self.twist.kappa / (self.damping * now.inserted_mm**2) * (now.time_s - last.time_s)
        innovation = now.tip_deg * _RAD - now.base_deg * _RAD - self._tip_past_base_rad(now)
        gain = scale * self._unit_gain
        # Implicit in the correction: stable however coarse the samples.
        step = np.linalg.solve(self._identity + gain @ self._row, gain[:, 0] * innovation)
        self._p[self._observed] += step

"""An estimator that identifies damping and torque bias from base angle and base torque.

At a known torque u, the rate of the base shows the damping: the mean angle of the
shaft turns at u / (beta l). An extended Kalman filter on

    state     (r = q_0 / 2, p_1 .. p_{n-1}, log beta, b),     u = measured torque - b
    dynamics  dr/dt = u / (beta l) - (dl/dt) / l * (stretching),   dp/dt as in controllers.twist
    measured  base - u f / kappa - tail = r + sum (-1)^k p_k

corrects all states together. log beta and b are random walks, so that the filter follows a
change of tissue or of the sensor's zero.

**Bias.** Before the base first turns, the shaft is untwisted and carries no torque: the reading is
bias and noise. With a bias drift of 0, the bias is estimated from these readings alone, as when a
sensor is zeroed. With a drift it stays a state of the filter. In viscous tissue it is observable: a
base at rest needs no torque, so a torque that is read while nothing turns is bias (0.1 N mm
would turn 10 cm in plastisol by 3.3 deg per second). Where tissue holds a real torque at rest (dry
friction for ever, soft tissue until it has crept back) it is not observable: the filter
then takes that torque for bias, and misses the lag that belongs to it.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from controllers.estimators import FeedforwardEstimator
from controllers.signals import Estimate, Sample
from models.errors import InvalidValue
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_ONE, _NONE = np.ones(1), np.zeros(1)
_DAMPING, _BIAS = -2, -1  # places in the state
_FIRST_TURN_DEG = 1.0  # of the base: until then the shaft counts as untwisted


class AdaptiveEstimator(FeedforwardEstimator):
    """The feedforward estimator, which also identifies damping and torque bias while it runs.

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: first guess of beta.
      order: modes with mode 0.
      base_noise_deg: standard deviation of the base angle.
      torque_noise_n_mm: standard deviation of the base torque; it acts on the base angle through the
        shaft's compliance.
      guess_spread: standard deviation of log beta at the start.
      drift_per_s: random walk of log beta, per square root of a second.
      turn_noise_deg: unmodelled motion of the mean angle, deg per square root of a second.
      bias_spread_n_mm: standard deviation of the torque bias before the first sample.
      bias_drift_n_mm: its random walk, N mm per square root of a second; 0: the bias is estimated
        until the base first turns, then kept.

    Raises:
      InvalidValue: a noise is not positive, or a spread of the bias is negative.
    """

    def __init__(
        self,
        needle: Needle,
        *,
        damping_n_mm_s_per_mm: float,
        order: int = 4,
        base_noise_deg: float = 0.05,
        torque_noise_n_mm: float = 0.015,
        guess_spread: float = 0.7,
        drift_per_s: float = 0.02,
        turn_noise_deg: float = 0.3,
        bias_spread_n_mm: float = 0.0,
        bias_drift_n_mm: float = 0.0,
    ) -> None:
        for name, value in (
            ("base_noise_deg", base_noise_deg),
            ("torque_noise_n_mm", torque_noise_n_mm),
            ("guess_spread", guess_spread),
            ("drift_per_s", drift_per_s),
            ("turn_noise_deg", turn_noise_deg),
        ):
            if not (math.isfinite(value) and value > 0):
                raise InvalidValue(name, value, "a finite number above 0")
        for name, value in (
            ("bias_spread_n_mm", bias_spread_n_mm),
            ("bias_drift_n_mm", bias_drift_n_mm),
        ):
            if not (math.isfinite(value) and value >= 0):
                raise InvalidValue(name, value, "a finite number of at least 0")
        self._bias_var, self._bias_drift = bias_spread_n_mm**2, bias_drift_n_mm
        self._guess = damping_n_mm_s_per_mm
        self._base_var, self._torque_var = (base_noise_deg * _RAD) ** 2, torque_noise_n_mm**2
        self._spread, self._drift = guess_spread, drift_per_s
        self._turn_var = (turn_noise_deg * _RAD) ** 2
        super().__init__(needle, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm, order=order)
        self._row = np.concatenate([_ONE, self.twist.sign, _NONE, _NONE])
        self._jacobian = np.eye(self._row.size)
        self._jacobian_diagonal = np.einsum("ii->i", self._jacobian)  # a view
        # All modes count at the base: what truncation drops of them is pi^2/6 - sum 1/k^2.
        self._tail = 2 / np.pi**2 * (np.pi**2 / 6 - float((1.0 / self.twist.k**2).sum()))

    def reset(self) -> None:
        """Go back to an untwisted shaft, the first guess of the damping, and no bias."""
        super().reset()
        self.damping, self.torque_bias_n_mm = self._guess, 0.0
        n = self.twist.k.size + 3
        self._mean_rad: float | None = None
        self._covariance = np.zeros((n, n))
        self._covariance[_DAMPING, _DAMPING] = self._spread**2
        self._covariance[_BIAS, _BIAS] = self._bias_var
        self._untwisted, self._start_deg = self._bias_var > 0, math.nan

    def update(self, sample: Sample) -> Estimate:
        """Take one sample; the estimated bias is subtracted from its torque."""
        if self._untwisted and sample.usable():
            self._weigh(sample)
        if self._bias_var == 0:
            return super().update(sample)
        return super().update(replace(sample, torque_n_mm=sample.torque_n_mm - self.torque_bias_n_mm))

    def _weigh(self, sample: Sample) -> None:
        """Estimate the bias from the torque of the untwisted shaft, until the base first turns."""
        if math.isnan(self._start_deg):
            self._start_deg = sample.base_deg
        self._untwisted = abs(sample.base_deg - self._start_deg) < _FIRST_TURN_DEG
        if self._untwisted:
            variance = self._covariance[_BIAS, _BIAS]
            gain = variance / (variance + self._torque_var)
            self.torque_bias_n_mm += gain * (sample.torque_n_mm - self.torque_bias_n_mm)
            self._covariance[_BIAS, :] *= 1 - gain
            self._covariance[:, _BIAS] *= 1 - gain
            self._covariance[_BIAS, _BIAS] = (1 - gain) * variance
        elif self._bias_drift == 0:
            self._covariance[_BIAS, :] = self._covariance[:, _BIAS] = 0.0

    def _advance(self, last: Sample, now: Sample) -> None:
        if self._mean_rad is None:
            self._mean_rad = last.base_deg * _RAD - self._base_past_mean(last)
        before = self._p.copy()
        super()._advance(last, now)
        dt, depth = now.time_s - last.time_s, 0.5 * (last.inserted_mm + now.inserted_mm)
        torque = 0.5 * (last.torque_n_mm + now.torque_n_mm)
        turned = torque * dt / (self.damping * depth)
        growth = (now.inserted_mm - last.inserted_mm) / depth
        # The mean over a longer shaft takes in what enters: shaft at the entry's angle.
        self._mean_rad += turned + growth * float(self.twist.sign @ before)
        self._predict(last, now, turned, before)
        self._correct(now)

    def _predict(self, last: Sample, now: Sample, turned: float, before: Array) -> None:
        """Propagate the covariance over one sample."""
        dt, depth = now.time_s - last.time_s, 0.5 * (last.inserted_mm + now.inserted_mm)
        # The Jacobian is diagonal but for two columns. beta only sets the pace, so that
        # d / d log beta of a step is minus the step; the bias acts as a torque.
        per_torque = dt / (self.damping * depth)
        jacobian = self._jacobian
        self._jacobian_diagonal[1:_DAMPING] = self._decay
        jacobian[0, _DAMPING] = -turned
        jacobian[1:_DAMPING, _DAMPING] = before - self._p
        jacobian[0, _BIAS] = -per_torque
        jacobian[1:_DAMPING, _BIAS] = (-2 * per_torque) * self.twist.sign
        self._covariance = jacobian @ self._covariance @ jacobian.T
        self._covariance[0, 0] += self._turn_var * dt
        self._covariance[_DAMPING, _DAMPING] += self._drift**2 * dt
        self._covariance[_BIAS, _BIAS] += self._bias_drift**2 * dt

    def _correct(self, now: Sample) -> None:
        """Correct the state by the measured base angle."""
        compliance = self._compliance(now)
        row = self._row
        row[_BIAS] = -compliance
        mean = self._mean_rad or 0.0
        innovation = now.base_deg * _RAD - mean - self._base_past_mean(now)
        spread = self._covariance @ row
        gain = spread / (row @ spread + self._base_var + self._torque_var * compliance**2)
        self._mean_rad = mean + gain[0] * innovation
        self._p = self._p + gain[1:_DAMPING] * innovation
        self.damping *= math.exp(min(max(gain[_DAMPING] * innovation, -0.5), 0.5))
        self.torque_bias_n_mm += gain[_BIAS] * innovation
        self._covariance = self._covariance - gain[:, None] * spread

    def _base_past_mean(self, sample: Sample) -> float:
        """Base angle minus the mean angle of the inserted shaft, rad."""
        immediate = sample.torque_n_mm * self._compliance(sample)
        return immediate + float(self.twist.sign @ self._p)

    def _compliance(self, sample: Sample) -> float:
        """Immediate compliance of the base to a torque, rad / (N mm): free shaft and tail."""
        return (sample.free_mm + sample.inserted_mm * self._tail) / self.twist.kappa

    def _read(self, sample: Sample) -> Estimate:
        estimate = super()._read(sample)
        return Estimate(estimate.tip_deg, estimate.modes_deg, self.damping, estimate.status)

"""An estimator that identifies the damping from base angle and base torque.

With the torque given, how fast the base turns tells the damping: the mean of the
shaft turns at u / (beta l). An extended Kalman filter on

    state  (r = q_0 / 2, p_1 .. p_{n-1}, log beta)
    dr/dt = u / (beta l) - (dl/dt) / l * (stretching),    dp/dt as in controllers.twist
    measured  base - u f / kappa - tail = r + sum (-1)^k p_k

corrects modes and damping together. log beta drifts as a random walk, so that a
change of tissue is followed.
"""

import math

import numpy as np
from numpy.typing import NDArray

from controllers.estimators import FeedforwardEstimator
from controllers.signals import Estimate, Sample
from models.errors import InvalidValue
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_ONE, _NONE = np.ones(1), np.zeros(1)


class AdaptiveEstimator(FeedforwardEstimator):
    """The feedforward estimator that identifies the damping online.

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: first guess of beta.
      order: modes with mode 0.
      base_noise_deg: of the base angle, one standard deviation.
      torque_noise_n_mm: of the base torque: it acts on the base angle through the shaft's compliance.
      guess_spread: relative uncertainty of the first guess (natural log).
      drift_per_s: random walk of log beta, per square root of a second.
      turn_noise_deg: unmodelled motion of the mean angle, deg per square root of a second.

    Raises:
      InvalidValue: a noise is not positive.
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
        self._guess = damping_n_mm_s_per_mm
        self._base_var, self._torque_var = (base_noise_deg * _RAD) ** 2, torque_noise_n_mm**2
        self._spread, self._drift = guess_spread, drift_per_s
        self._turn_var = (turn_noise_deg * _RAD) ** 2
        super().__init__(needle, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm, order=order)
        self._row = np.concatenate([_ONE, self.twist.sign, _NONE])
        # All modes count at the base: what truncation drops of them is pi^2/6 - sum 1/k^2.
        self._tail = 2 / np.pi**2 * (np.pi**2 / 6 - float((1.0 / self.twist.k**2).sum()))

    def reset(self) -> None:
        """Untwisted, with the first guess of the damping."""
        super().reset()
        self.damping = self._guess
        n = self.twist.k.size + 2
        self._mean_rad: float | None = None
        self._covariance = np.zeros((n, n))
        self._covariance[-1, -1] = self._spread**2

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
        self._mean_rad += turned + growth * float((self.twist.sign * before).sum())
        self._predict(last, now, turned, before)
        self._correct(now)

    def _predict(self, last: Sample, now: Sample, turned: float, before: Array) -> None:
        """Covariance over one sample."""
        dt, depth = now.time_s - last.time_s, 0.5 * (last.inserted_mm + now.inserted_mm)
        # The Jacobian is diagonal but for its last column: beta only sets the pace, so
        # d / d log beta of a step is minus the step.
        decay = np.exp(self.twist.poles(depth, self.damping) * dt)
        diagonal = np.concatenate([_ONE, decay, _ONE])
        column = np.concatenate([[-turned], before - self._p, _NONE])
        half = diagonal[:, None] * self._covariance + column[:, None] * self._covariance[-1]
        self._covariance = half * diagonal + half[:, -1:] * column
        self._covariance[0, 0] += self._turn_var * dt
        self._covariance[-1, -1] += self._drift**2 * dt

    def _correct(self, now: Sample) -> None:
        """The base angle as a measurement."""
        row = self._row
        mean = self._mean_rad or 0.0
        innovation = now.base_deg * _RAD - mean - self._base_past_mean(now)
        spread = self._covariance @ row
        gain = spread / (row @ spread + self._base_var + self._torque_var * self._compliance(now) ** 2)
        self._mean_rad = mean + gain[0] * innovation
        self._p = self._p + gain[1:-1] * innovation
        self.damping *= math.exp(min(max(gain[-1] * innovation, -0.5), 0.5))
        self._covariance = self._covariance - np.outer(gain, spread)

    def _base_past_mean(self, sample: Sample) -> float:
        """Base angle minus the mean angle of the inserted shaft, rad."""
        immediate = sample.torque_n_mm * self._compliance(sample)
        return immediate + float((self.twist.sign * self._p).sum())

    def _compliance(self, sample: Sample) -> float:
        """Immediate compliance of the base to a torque, rad / (N mm): free shaft and tail."""
        return (sample.free_mm + sample.inserted_mm * self._tail) / self.twist.kappa

    def _read(self, sample: Sample) -> Estimate:
        estimate = super()._read(sample)
        return Estimate(estimate.tip_deg, estimate.modes_deg, self.damping, estimate.status)

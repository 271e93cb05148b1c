"""Roll of the tip from the base and from images of the tip together: an error-state Kalman filter.

Angle and torque of the base give the roll of the tip at every sample, as in
controllers.estimators. This estimate drifts if the model is wrong: bias of the torque sensor, a
torque at the tip, friction elsewhere than assumed. Images give the position of the tip. If its
roll is off by an angle a, the tip leaves the expected path by a s^2 / 2R over a travel s, which
makes the roll observable. State and error state (true minus estimated) are

    position p and direction F of the tip (SO(3)), errors dp, dphi    controllers.steering.tip_pose
    modes p_k of the twist                                            controllers.twist
    bias of the torque sensor, constant
    lag of the tip that the model does not have, a random walk
    white noise of the torque in this sample, which enters the next step too
    position at the last exposure (a clone: images arrive late)

    roll = base - (u - bias - noise) f / kappa + tail + 2 sum over odd k of p_k + lag

An image is compared with the clone, so the delay of images costs no accuracy.
"""

import math
from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from controllers.estimators import FeedforwardEstimator
from controllers.signals import Estimate, Sample, Status
from controllers.steering.tip_pose import TipPose
from models.needle import Needle, NonNegative, Positive
from models.record import Record

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_POSITION, _DIRECTION, _MODES = slice(0, 3), slice(3, 6), 6
_LOG_2PI = math.log(2 * math.pi)


class FusionNoise(Record):
    """Standard deviations that the filter assumes.

    With zero for bias and lag, the roll from the base counts as right: images correct the pose only.
    """

    image_mm: Positive = 0.5
    """Of each coordinate in an image."""
    torque_n_mm: NonNegative = 0.015
    """White noise of the base torque, each sample."""
    torque_bias_n_mm: NonNegative = 0.3
    """Of the torque sensor's bias."""
    lag_deg: NonNegative = 1.0
    """Of the lag that the model lacks, at the start."""
    lag_drift_deg: NonNegative = 2.0
    """Of its random walk, per square root of a second."""
    start_mm: NonNegative = 0.1
    """Of each coordinate of the tip at the start."""
    start_direction_deg: NonNegative = 1.0
    """Of the tip's direction at the start, about each axis."""
    direction_drift_deg: NonNegative = 0.05
    """Bends of the path that curvature does not explain, per square root of a millimetre."""


class FusedEstimator(FeedforwardEstimator):
    """The feedforward estimator with images of the tip's position.

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: beta.
      radius_mm: radius of curvature of the tip's path.
      noise: assumed standard deviations.
      start_mm: position of the tip at the first sample, (3,); it heads along x.
      order: modes with mode 0.

    Attributes:
      pose: estimated pose of the tip.
      bias_n_mm, lag_rad: estimated bias of the torque, and lag that the model does not have.
      covariance: covariance of the error state, in the order of the module's docstring.
      transition: transition matrix of the error state over the last step.

    Raises:
      InvalidValue: the radius or the damping is not positive, or the order is below 2.
    """

    def __init__(
        self,
        needle: Needle,
        *,
        damping_n_mm_s_per_mm: float,
        radius_mm: float,
        noise: FusionNoise = FusionNoise(),  # noqa: B008 - frozen
        start_mm: ArrayLike = (0.0, 0.0, 0.0),
        order: int = 4,
    ) -> None:
        self.noise, self._radius_mm, self._start_mm = noise, radius_mm, start_mm
        self._size = _MODES + order - 1
        super().__init__(needle, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm, order=order)

    def reset(self) -> None:
        """Go back to the state before the first sample: untwisted, at the start."""
        super().reset()
        noise, n = self.noise, self._size
        self._modes, self._bias, self._lag, self._white = slice(_MODES, n), n, n + 1, n + 2
        self._clone = slice(n + 3, n + 6)
        self.pose = TipPose(self._radius_mm, self._start_mm)
        self.bias_n_mm, self.lag_rad, self._noise_n_mm = 0.0, 0.0, 0.0
        spread = np.zeros(n + 6)
        spread[_POSITION], spread[_DIRECTION] = noise.start_mm, noise.start_direction_deg * _RAD
        spread[self._bias], spread[self._lag] = noise.torque_bias_n_mm, noise.lag_deg * _RAD
        spread[self._white] = noise.torque_n_mm
        self.covariance = np.diag(spread**2)
        self._cloned_mm: Array | None = None
        self._row, self._roll_rad = np.zeros(n + 6), 0.0
        self._transition, self._from_noise = np.eye(n + 6), np.zeros(n + 6)
        self.transition = self._transition.copy()
        self._transition[self._white, self._white], self._from_noise[self._white] = 0.0, 1.0

    def update(self, sample: Sample) -> Estimate:
        """Take one sample of the base: torsion first, then the pose with the new roll."""
        last = self._last
        estimate = super().update(sample)
        if estimate.status not in (Status.OK, Status.OUTSIDE):
            return estimate
        row, roll = self._roll_row(sample, estimate.status), estimate.tip_deg * _RAD
        if last is not None:
            if estimate.status is Status.OUTSIDE:
                self._transition[self._modes], self._from_noise[self._modes] = 0.0, 0.0
            self._propagate(last, sample, row, 0.5 * (self._roll_rad + roll))
        self._row, self._roll_rad = row, roll
        return estimate

    def expose(self) -> None:
        """An image is taken now; `see` brings what it shows."""
        self._cloned_mm = self.pose.position_mm.copy()
        self.covariance[self._clone] = self.covariance[_POSITION]
        self.covariance[:, self._clone] = self.covariance[:, _POSITION]

    def see(self, position_mm: ArrayLike) -> float:
        """Correct by the tip's position, (3,), at the last exposure.

        Returns:
          Log likelihood of the image; 0 for one that is not finite, which is left out.
        """
        seen = np.asarray(position_mm, float)
        if self._cloned_mm is None or not np.isfinite(seen).all():
            return 0.0
        innovation = seen - self._cloned_mm
        cross = self.covariance[:, self._clone]
        expected = cross[self._clone] + self.noise.image_mm**2 * np.eye(3)
        weighted = np.linalg.solve(expected, innovation)
        self.covariance -= cross @ np.linalg.solve(expected, cross.T)
        self._inject(cross @ weighted)
        log_determinant = float(np.linalg.slogdet(expected)[1])
        return -0.5 * (float(innovation @ weighted) + log_determinant + 3 * _LOG_2PI)

    @property
    def tip_spread_deg(self) -> float:
        """Standard deviation of the estimated roll, deg."""
        return math.sqrt(max(float(self._row @ self.covariance @ self._row), 0.0)) / _RAD

    def _advance(self, last: Sample, now: Sample) -> None:
        """Advance the modes by one sample, and the transition matrix of their errors."""
        denoised = replace(last, torque_n_mm=last.torque_n_mm - self._noise_n_mm)
        super()._advance(self._unbiased(denoised), self._unbiased(now))
        dt, depth = now.time_s - last.time_s, 0.5 * (last.inserted_mm + now.inserted_mm)
        z = self.twist.poles(depth, self.damping) * dt
        growth = (now.inserted_mm - last.inserted_mm) / depth
        stretched = np.eye(z.size) - growth * self.twist.stretch
        gain = 2 * dt / (depth * self.damping) * self.twist.sign
        whole, ramp = np.expm1(z) / z, (np.expm1(z) - z) / z**2
        transition = self._transition
        transition[self._modes, self._modes] = np.exp(z)[:, None] * stretched
        transition[self._modes, self._bias] = -gain * whole
        transition[self._modes, self._white] = -gain * (whole - ramp)
        self._from_noise[self._modes] = -gain * ramp

    def _read(self, sample: Sample) -> Estimate:
        estimate = super()._read(self._unbiased(sample))
        return replace(estimate, tip_deg=estimate.tip_deg + self.lag_rad / _RAD)

    def _unbiased(self, sample: Sample) -> Sample:
        return replace(sample, torque_n_mm=sample.torque_n_mm - self.bias_n_mm)

    def _roll_row(self, sample: Sample, status: Status) -> Array:
        """Row that gives the error of the roll from the error state; outside tissue, roll = base."""
        row = np.zeros(self._size + 6)
        if status is Status.OK:
            tail_rad = self.twist.tail_rad(1.0, sample.inserted_mm)
            row[self._modes] = 2.0 * self.twist.odd
            row[[self._bias, self._white]] = sample.free_mm / self.twist.kappa - tail_rad
            row[self._lag] = 1.0
        return row

    def _propagate(self, last: Sample, now: Sample, row: Array, roll_rad: float) -> None:
        """Advance pose and covariance by one sample."""
        travel = now.inserted_mm - last.inserted_mm
        step = self.pose.advance(travel, roll_rad)
        moved, noise = self._transition.copy(), self._from_noise.copy()
        moved[_POSITION, _DIRECTION] = step.direction_on_position
        for part, on_it in ((_POSITION, step.roll_on_position), (_DIRECTION, step.roll_on_direction)):
            moved[part] += np.outer(on_it, 0.5 * (self._row + row @ self._transition))
            noise[part] = on_it * 0.5 * float(row @ self._from_noise)
        self.transition, self._noise_n_mm = moved, 0.0
        self.covariance = moved @ self.covariance @ moved.T
        self.covariance += self.noise.torque_n_mm**2 * np.outer(noise, noise)
        direction = (self.noise.direction_drift_deg * _RAD) ** 2 * abs(travel)
        self.covariance[_DIRECTION, _DIRECTION] += direction * np.eye(3)
        drift = (self.noise.lag_drift_deg * _RAD) ** 2 * (now.time_s - last.time_s)
        self.covariance[self._lag, self._lag] += drift

    def _inject(self, error: Array) -> None:
        """Add the estimated error to the state, which sets the error state to zero."""
        self.pose.correct(error[_POSITION], error[_DIRECTION])
        self._p = self._p + error[self._modes]
        self.bias_n_mm += float(error[self._bias])
        self.lag_rad += float(error[self._lag])
        self._noise_n_mm += float(error[self._white])
        self._roll_rad += float(self._row @ error)
        if self._cloned_mm is not None:
            self._cloned_mm = self._cloned_mm + error[self._clone]

"""A servo that brings a shaft to a commanded angle: a second-order system.

    angle'' = w^2 (command - angle) - 2 d w angle',     w = 2 pi f

with natural frequency f and damping ratio d. A command that is held over a step of
length h is an equilibrium, so that the state x = (angle, rate) moves exactly by

    x(t + h) = x_c + e^(A h) (x(t) - x_c),     x_c = (command, 0).
"""

import math
from functools import cache

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import expm

from models.needle import Positive
from models.record import Record

Array = NDArray[np.float64]


class Servo(Record):
    """Dynamics of a position servo."""

    natural_frequency_hz: Positive
    damping_ratio: Positive = 0.7

    @property
    def rate_rad_s(self) -> float:
        """w = 2 pi f, rad/s."""
        return 2 * math.pi * self.natural_frequency_hz

    @property
    def lag_s(self) -> float:
        """Time by which the shaft lags behind a slowly moving command: 2 d / w, s."""
        return 2 * self.damping_ratio / self.rate_rad_s

    @property
    def matrix(self) -> Array:
        """A of the module's docstring, (2, 2)."""
        w = self.rate_rad_s
        return np.array([[0.0, 1.0], [-(w**2), -2 * self.damping_ratio * w]])

    def after(self, state: Array, command: float, step_s: float) -> Array:
        """Angle and rate, (2,), after a step with a held command, in the units of the command."""
        held = np.array([command, 0.0])
        moved: Array = held + _transition(self, round(step_s, 12)) @ (state - held)
        return moved


@cache
def _transition(servo: Servo, step_s: float) -> Array:
    return np.asarray(expm(servo.matrix * step_s), np.float64)

"""Pitch and roll against a plane from images of the height alone: an observer after ref. [8].

In x = (z, t_z, d_z) of controllers.steering.planar the needle is linear, except for its input, e_z
times the roll. Over a travel s without roll

    x(s) = Phi(s) x,    Phi(s) = [1  sin(ks)/k  (1 - cos(ks))/k;  0  cos(ks)  sin(ks);
                                  0  -sin(ks)  cos(ks)]

and a roll by a turns (d_z, e_z) by a, with e_z = sqrt(1 - t_z^2 - d_z^2) as in ref. [8]:
within a quarter turn of lying in the plane. Images, h of travel apart, correct it
(Luenberger) by L (y - z_hat), so that the error obeys

    e_{j+1} = Phi(h) (I - L C) e_j,    poles of Phi(h) (I - L C) = exp(-h / observer length), thrice

Images arrive late. An image is compared with the height that was predicted for its exposure,
and Phi carries the correction over the travel since then; this is exact if the tip did not roll
in between.
"""

import math

import control
import numpy as np
from numpy.typing import NDArray

from controllers.steering.planar import PlanarState
from models.errors import InvalidValue

Array = NDArray[np.float64]

_LEAST_TRAVEL_MM = 1e-3  # between images: a needle at rest shows nothing new but noise
_STEEPEST = 0.999  # of the part of the unit vector that is estimated


class PlanarObserver:
    """Height, pitch and roll of the tip against the plane z = 0.

    Args:
      radius_mm: radius of curvature of the needle.
      settling_mm: travel over which errors of the estimate fall by a factor e.

    Raises:
      InvalidValue: one of them is not positive.
    """

    def __init__(self, *, radius_mm: float, settling_mm: float = 7.0) -> None:
        for name, value in (("radius_mm", radius_mm), ("settling_mm", settling_mm)):
            if not (math.isfinite(value) and value > 0):
                raise InvalidValue(name, value, "a finite number above 0")
        self.curvature, self.settling_mm = 1.0 / radius_mm, settling_mm
        self._gains: dict[int, Array] = {}
        self.reset()

    def reset(self) -> None:
        """Go back to the state before the first image: parallel to the plane, at an unknown height."""
        self._x = np.zeros(3)
        self._started = False
        self._exposed_height_mm = 0.0
        self._apart_mm, self._since_mm = 0.0, 0.0

    @property
    def state(self) -> PlanarState:
        """The estimated state."""
        height, slope, pull = (float(value) for value in self._x)
        return PlanarState(height, slope, pull, math.sqrt(max(1.0 - slope**2 - pull**2, 0.0)))

    def advance(self, travel_mm: float, roll_rad: float) -> None:
        """Predict over a short travel in which the tip rolls."""
        pull, facing = self._x[2], self.state.facing
        self._x = self.transition(travel_mm) @ self._x
        self._x[2] += facing * math.sin(roll_rad) - pull * (1 - math.cos(roll_rad))
        self._since_mm += travel_mm

    def expose(self) -> None:
        """An image is taken now; `see` brings what it shows."""
        self._exposed_height_mm = float(self._x[0])
        self._apart_mm, self._since_mm = self._since_mm, 0.0

    def see(self, height_mm: float) -> None:
        """Correct by the height at the last exposure, mm; a value that is not finite is ignored."""
        if not math.isfinite(height_mm):
            return
        innovation = height_mm - self._exposed_height_mm
        if not self._started:
            self._x[0] += innovation
            self._started = True
        elif self._apart_mm > _LEAST_TRAVEL_MM:
            self._x += self.transition(self._since_mm) @ self.gain(self._apart_mm) * innovation
        self._keep_direction()

    def transition(self, travel_mm: float) -> Array:
        """Phi of the module's docstring over a travel, (3, 3)."""
        k = self.curvature
        s, c = math.sin(k * travel_mm), math.cos(k * travel_mm)
        return np.array([[1.0, s / k, (1 - c) / k], [0.0, c, s], [0.0, -s, c]])

    def gain(self, apart_mm: float) -> Array:
        """L for images that are a travel apart, (3,); cached in steps of a micrometre."""
        key = max(1, round(apart_mm * 1000))
        if key not in self._gains:
            step = self.transition(key / 1000)
            poles = np.full(3, math.exp(-key / 1000 / self.settling_mm))
            placed = np.asarray(control.acker(step.T, np.eye(3)[:, :1], poles)).ravel()
            self._gains[key] = np.linalg.solve(step, placed)
        return self._gains[key]

    def _keep_direction(self) -> None:
        """Keep the components of the unit vector within 1 in spite of noise."""
        length = math.hypot(self._x[1], self._x[2])
        if length > _STEEPEST:
            self._x[1:] *= _STEEPEST / length

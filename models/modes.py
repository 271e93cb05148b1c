"""The continuous needle in viscous tissue: modes, poles, and exact responses.

Equation (9), kappa theta'' = eta theta_tt + beta theta_t, on the inserted length
0 <= x <= l, free at the tip; a free length f between chuck and tissue carries
torque without friction. Separation of variables (12)-(14) gives shapes
cos(w (l - x)) whose wavenumbers w depend on the quantity that is given at the base:

    torque given (free - free):   w = k pi / l                  (14)
    angle given:                  w l tan(w l) = l / f;  f = 0: w = (k - 1/2) pi / l

and, without inertia, poles  -kappa w^2 / beta  (23a). With inertia each of these
becomes the slow root of eta s^2 + beta s + kappa w^2 = 0 (19) when f = 0; with a
free length the roots solve (both sides scaled)

    angle given:   g_f cosh(g_f f) cosh(g_t l) + g_t sinh(g_f f) sinh(g_t l) = 0
    torque given:  g_f sinh(g_f f) cosh(g_t l) + g_t cosh(g_f f) sinh(g_t l) = 0

with g_f^2 = eta s^2 / kappa and g_t^2 = (eta s^2 + beta s) / kappa.

Units here: mm, N mm, s, rad.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq, newton

from models.drive import DriveKind
from models.errors import InvalidValue
from models.needle import Needle
from models.relaxation import relaxing_modes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class InsertedNeedle:
    """A needle held in viscous tissue at one depth.

    Attributes:
      needle: the shaft.
      damping_n_mm_s_per_mm: beta, viscous torque per rad/s and per mm inserted.
      inserted_mm: l, length in contact with tissue.
      free_mm: f, length between chuck and tissue.
      drive: which quantity is given at the base.

    Raises:
      InvalidValue: damping or inserted length is not positive, or free is negative.
    """

    needle: Needle
    damping_n_mm_s_per_mm: float
    inserted_mm: float
    free_mm: float = 0.0
    drive: DriveKind = DriveKind.ANGLE

    def __post_init__(self) -> None:
        for name in ("damping_n_mm_s_per_mm", "inserted_mm"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InvalidValue(name, value, "a finite number above 0")
        if not (np.isfinite(self.free_mm) and self.free_mm >= 0):
            raise InvalidValue("free_mm", self.free_mm, "a finite length of at least 0 mm")

    @property
    def damping_n_mm_s(self) -> float:
        """b = beta l, N mm s (7)."""
        return self.damping_n_mm_s_per_mm * self.inserted_mm

    def wavenumbers_per_mm(self, count: int) -> Array:
        """The lowest `count` wavenumbers, 1/mm; for a given torque the first is 0."""
        length, free = self.inserted_mm, self.free_mm
        if self.drive is DriveKind.TORQUE:
            return np.asarray(np.arange(count) * np.pi / length, np.float64)
        if free == 0:
            return np.asarray((np.arange(count) + 0.5) * np.pi / length, np.float64)

        def robin(y: float) -> float:
            return float(y * np.sin(y) - length / free * np.cos(y))

        roots = [brentq(robin, k * np.pi, (k + 0.5) * np.pi, xtol=1e-14) for k in range(count)]
        return np.array(roots) / length

    def poles_rad_s(self, count: int) -> Array:
        """The slowest `count` poles without inertia, rad/s, slowest first (23a)."""
        wavenumbers = self.wavenumbers_per_mm(count)
        return -self.needle.rigidity_n_mm2 / self.damping_n_mm_s_per_mm * wavenumbers**2

    def poles_with_inertia_rad_s(self, count: int) -> Array:
        """The slowest `count` poles with the needle's inertia, rad/s."""
        poles = self.poles_rad_s(count)
        if self.free_mm == 0:
            return np.array([self._slow_root(pole) for pole in poles])
        roots = [p if p == 0 else newton(self._characteristic, p, tol=1e-13 * abs(p)) for p in poles]
        return np.array(roots)

    def overtones_rad_s(self, count: int) -> NDArray[np.complex128]:
        """The fast root of each mode in (19), without free length, rad/s."""
        eta, beta = self._inertia, self.damping_n_mm_s_per_mm
        square = beta**2 + 4 * eta * beta * self.poles_rad_s(count).astype(complex)
        return np.asarray((-beta - np.sqrt(square)) / (2 * eta), np.complex128)

    @property
    def _inertia(self) -> float:
        # kg m is N s^2, and N mm s^2 per mm is the same number.
        return self.needle.rotary_inertia_kg_m

    def _slow_root(self, pole: float) -> float:
        eta, beta = self._inertia, self.damping_n_mm_s_per_mm
        # Root of eta s^2 + beta s - beta pole = 0, in the form that does not cancel.
        return float(2 * pole / (1 + np.sqrt(1 + 4 * eta * pole / beta)))

    def _characteristic(self, s: float) -> float:
        """The equation of the module's docstring, divided by g_f: real for real s."""
        kappa = self.needle.rigidity_n_mm2
        free = np.sqrt(complex(self._inertia * s**2 / kappa))
        tissue = np.sqrt(complex((self._inertia * s**2 + self.damping_n_mm_s_per_mm * s) / kappa))
        f, length = self.free_mm, self.inserted_mm
        sinh_over = np.sinh(free * f) / free
        if self.drive is DriveKind.ANGLE:
            value = np.cosh(free * f) * np.cosh(tissue * length)
            value += tissue * sinh_over * np.sinh(tissue * length)
        else:
            value = free**2 * sinh_over * np.cosh(tissue * length) / tissue
            value += np.cosh(free * f) * np.sinh(tissue * length)
            value /= tissue
        return float(value.real)

    def participation(self, count: int) -> Array:
        """Coefficients of 1 in the modes: 1 = sum a_k cos(w_k (l - x))."""
        w, length = self.wavenumbers_per_mm(count), self.inserted_mm
        wl = w * length
        with np.errstate(invalid="ignore", divide="ignore"):
            a = np.sin(wl) / w / (length / 2 + np.sin(2 * wl) / (4 * w))
        return np.where(w == 0, 1.0, a)

    def respond(self, time_s: ArrayLike, drive_rad: ArrayLike, *, count: int = 60) -> "Response":
        """Exact response, from rest, to a base angle that is linear between samples.

        With theta = u + sum c_k cos(w_k (l - x)):  dc_k/dt = p_k c_k - a_k du/dt.

        Args:
          time_s: increasing times, (N,).
          drive_rad: base angle at those times, rad, (N,).
          count: modes kept.

        Raises:
          InvalidValue: the needle is not driven by angle, or times do not increase.
        """
        if self.drive is not DriveKind.ANGLE:
            raise InvalidValue("drive", self.drive.value, "'angle'", "use control.forced_response")
        t, u = np.asarray(time_s, float), np.asarray(drive_rad, float)
        c = relaxing_modes(t, u, self.poles_rad_s(count), self.participation(count))
        wavenumbers = self.wavenumbers_per_mm(count)
        shapes = np.sin(wavenumbers * self.inserted_mm) * wavenumbers
        torque = -self.needle.rigidity_n_mm2 * c @ shapes
        return Response(time_s=t, tip_rad=u + c.sum(axis=1), base_torque_n_mm=torque, modes_rad=c)


@dataclass(frozen=True, kw_only=True)
class Response:
    """Response of the closed form: times, tip and torque, (N,) each; modes, (N, count)."""

    time_s: Array
    tip_rad: Array
    base_torque_n_mm: Array
    modes_rad: Array


def ramp(time_s: ArrayLike, *, by: float, duration_s: float) -> Array:
    """A turn at constant rate: 0 before 0, `by` after `duration_s` (0: a step)."""
    t: Any = np.asarray(time_s, float)
    if duration_s == 0:
        return np.asarray(by * (t > 0), np.float64)
    return np.asarray(by * np.clip(t / duration_s, 0.0, 1.0), np.float64)

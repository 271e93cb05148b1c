"""The continuous needle in viscous, yielding tissue: poles and exact responses.

Friction beta acts against the slip between shaft and tissue, and the tissue at the shaft turns
by phi against a spring k and, parallel to it, a damper k tau (Kelvin-Voigt, (26)-(30) per mm):

    kappa theta'' = beta (theta_t - phi_t) = k phi + k tau phi_t,

so that torque per length over angle is, without inertia, the series

    Z(s) = beta s k (1 + tau s) / (beta s + k (1 + tau s)),     kappa theta'' = Z(s) theta.

Z does not depend on x, so the shapes and wavenumbers w are those of viscous tissue, with and
without a free length and for either drive (`models.modes`). Each has two poles, Z(s) = -m with
m = kappa w^2:

    beta k tau s^2 + (beta k + m (beta + k tau)) s + m k = 0.

Its discriminant, (beta k - m k tau)^2 + m^2 beta^2 + 2 m beta (beta k + m k tau), is positive:
both are real. The fast pole is the shaft against friction and damper in series, the slow one
tissue that creeps back: for high modes it tends to -k / (beta + k tau), from above. In a
turn of the base, the shares of the two poles of a mode are the residues of Z / (s (Z + m)),

    g = beta k (1 + tau s) / (2 beta k tau s + beta k + m (beta + k tau)),   g_slow + g_fast = 1.

Units here: mm, N mm, s, rad.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle, Response
from models.relaxation import relaxing_modes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class YieldingTissueNeedle:
    """A needle held at one depth in tissue that yields as a Kelvin-Voigt element.

    Attributes:
      viscous: the same needle in tissue that does not yield: beta, lengths, drive.
      stiffness_n_mm_per_rad_per_mm: k, stiffness of the tissue.
      time_constant_s: tau, damper / spring.

    Raises:
      InvalidValue: stiffness or time constant is not positive.
    """

    viscous: InsertedNeedle
    stiffness_n_mm_per_rad_per_mm: float
    time_constant_s: float

    def __post_init__(self) -> None:
        for name in ("stiffness_n_mm_per_rad_per_mm", "time_constant_s"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value > 0):
                raise InvalidValue(name, value, "a finite number above 0")

    @property
    def creep_limit_rad_s(self) -> float:
        """-k / (beta + k tau), rad/s: the limit of the slow poles for high modes."""
        k = self.stiffness_n_mm_per_rad_per_mm
        return -k / (self.viscous.damping_n_mm_s_per_mm + k * self.time_constant_s)

    def poles_rad_s(self, count: int) -> Array:
        """Slow and fast pole of the lowest `count` modes, rad/s, (count, 2).

        For a given torque the first mode is the shaft turning as a whole: 0 and -1 / tau.
        """
        square, linear, constant = self._quadratic(count)
        # The form without cancellation: both terms of the sum are positive.
        half = 0.5 * (linear + np.sqrt(linear**2 - 4 * square * constant))
        return np.stack([-constant / half, -half / square], axis=-1)

    def shares(self, count: int) -> Array:
        """Shares g of the slow and the fast pole in each mode of a base turn, (count, 2)."""
        square, linear, _ = self._quadratic(count)
        s, k = self.poles_rad_s(count), self.stiffness_n_mm_per_rad_per_mm
        friction = self.viscous.damping_n_mm_s_per_mm * k
        slope = 2 * square * s + linear[:, None]
        return np.asarray(friction * (1 + self.time_constant_s * s) / slope, np.float64)

    def respond(self, time_s: ArrayLike, drive_rad: ArrayLike, *, count: int = 60) -> Response:
        """Exact response, from rest, to a base angle that is linear between samples.

        Args:
          time_s: increasing times, (N,).
          drive_rad: base angle at those times, rad, (N,).
          count: modes kept.

        Raises:
          InvalidValue: the needle is not driven by angle, or times do not increase.
        """
        if self.viscous.drive is not DriveKind.ANGLE:
            raise InvalidValue(
                "drive", self.viscous.drive.value, "'angle', because a base angle is given"
            )
        t, u = np.asarray(time_s, float), np.asarray(drive_rad, float)
        shares = self.shares(count) * self.viscous.participation(count)[:, None]
        terms = relaxing_modes(t, u, self.poles_rad_s(count).ravel(), shares.ravel())
        modes = terms.reshape(t.size, count, 2).sum(axis=2)
        w = self.viscous.wavenumbers_per_mm(count)
        slopes = w * np.sin(w * self.viscous.inserted_mm)
        torque = -self.viscous.needle.rigidity_n_mm2 * modes @ slopes
        return Response(
            time_s=t, tip_rad=u + modes.sum(axis=1), base_torque_n_mm=torque, modes_rad=modes
        )

    def _quadratic(self, count: int) -> tuple[float, Array, Array]:
        """Coefficients of s^2, s and 1 in the module's quadratic, (count,) but the first."""
        beta, k = self.viscous.damping_n_mm_s_per_mm, self.stiffness_n_mm_per_rad_per_mm
        damper = k * self.time_constant_s
        m = self.viscous.needle.rigidity_n_mm2 * self.viscous.wavenumbers_per_mm(count) ** 2
        return beta * damper, beta * k + m * (beta + damper), m * k

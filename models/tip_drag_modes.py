"""The continuous needle in viscous tissue with a viscous drag c at its tip: poles, exact responses.

Without inertia, kappa theta'' = beta theta_t along the inserted length l, and at its ends

    kappa theta'(l) = -c theta_t(l)                        the tip's drag
    theta(0) - f theta'(0) = base,  or  theta'(0) = 0      angle given (free length f), or torque.

A mode of wavenumber w has the pole s = -kappa w^2 / beta, as without drag. With d = c / beta, the
length of shaft that resists as much as the tip, its shape is cos(w (l-x)) - w d sin(w (l-x)),
which is cos(w (l-x) + atan(w d)) up to a factor, and the base's condition is

    angle given:    w l + atan(w d) + atan(w f) = (k + 1/2) pi,     k = 0, 1, ...
    torque given:   w l + atan(w d)             = k pi.

The left side rises with w and exceeds w l by less than pi, so each k has exactly one root in a
known bracket; drag at one end and free length at the other have the same form. With d = 0 these are
the wavenumbers of `models.modes`. The shapes are orthogonal in the weight beta dx + c at the tip,
which also gives the share of each in a uniform turn.

Units here: mm, N mm, s, rad.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle, Response
from models.relaxation import relaxing_modes

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class TipDragNeedle:
    """A needle held at one depth in viscous tissue that also resists at the tip.

    Attributes:
      shaft: the same needle without drag at its tip: beta, lengths, drive.
      tip_drag_n_mm_s_per_rad: c, drag of the tip; 0: none.

    Raises:
      InvalidValue: the drag is negative.
    """

    shaft: InsertedNeedle
    tip_drag_n_mm_s_per_rad: float

    def __post_init__(self) -> None:
        drag = self.tip_drag_n_mm_s_per_rad
        if not (np.isfinite(drag) and drag >= 0):
            raise InvalidValue("tip_drag_n_mm_s_per_rad", drag, "a finite number of at least 0")

    @property
    def drag_length_mm(self) -> float:
        """d = c / beta: the length of inserted shaft that resists as much as the tip."""
        return self.tip_drag_n_mm_s_per_rad / self.shaft.damping_n_mm_s_per_mm

    def wavenumbers_per_mm(self, count: int) -> Array:
        """The lowest `count` wavenumbers, 1/mm; for a given torque the first is 0."""
        first = 0.5 if self.shaft.drive is DriveKind.ANGLE else 0.0
        return np.array([self._wavenumber((k + first) * np.pi) for k in range(count)])

    def _wavenumber(self, phase: float) -> float:
        """The root of the phase condition; it lies within pi / l below phase / l."""
        if phase == 0:
            return 0.0
        length = self.shaft.inserted_mm
        low, high = max(phase - np.pi, 0.0) / length, phase / length
        # Relative to the root: the pole goes with its square.
        return float(brentq(lambda w: self._phase(w) - phase, low, high, xtol=1e-15 / length))

    def _phase(self, wavenumber: float) -> float:
        free = self.shaft.free_mm if self.shaft.drive is DriveKind.ANGLE else 0.0
        ends = np.arctan(wavenumber * self.drag_length_mm) + np.arctan(wavenumber * free)
        return float(wavenumber * self.shaft.inserted_mm + ends)

    def poles_rad_s(self, count: int) -> Array:
        """The slowest `count` poles without inertia, rad/s, slowest first."""
        kappa, beta = self.shaft.needle.rigidity_n_mm2, self.shaft.damping_n_mm_s_per_mm
        return np.asarray(-kappa / beta * self.wavenumbers_per_mm(count) ** 2, np.float64)

    def participation(self, count: int) -> Array:
        """Coefficients of 1 in the shapes, which are 1 at the tip: 1 = sum a_k psi_k(x)."""
        w, length, d = self.wavenumbers_per_mm(count), self.shaft.inserted_mm, self.drag_length_mm
        phase = np.arctan(w * d)
        turned = w * length + phase
        with np.errstate(invalid="ignore", divide="ignore"):
            # Of cos(w (l-x) + phase), over the shaft and, weighted with d, at the tip.
            mean = (np.sin(turned) - np.sin(phase)) / w + d * np.cos(phase)
            square = 0.5 * length + (np.sin(2 * turned) - np.sin(2 * phase)) / (4 * w)
            a = mean * np.cos(phase) / (square + d * np.cos(phase) ** 2)
        return np.where(w == 0, 1.0, a)

    def respond(self, time_s: ArrayLike, drive_rad: ArrayLike, *, count: int = 60) -> Response:
        """Exact response, from rest, to a base angle that is linear between samples.

        Args:
          time_s: increasing times, (N,).
          drive_rad: base angle at those times, rad, (N,).
          count: modes kept.

        Raises:
          InvalidValue: the needle is not driven by angle, or times do not increase.
        """
        if self.shaft.drive is not DriveKind.ANGLE:
            raise InvalidValue("drive", self.shaft.drive.value, "'angle', because a base angle is given")
        t, u = np.asarray(time_s, float), np.asarray(drive_rad, float)
        w, wl = self.wavenumbers_per_mm(count), self.wavenumbers_per_mm(count) * self.shaft.inserted_mm
        c = relaxing_modes(t, u, self.poles_rad_s(count), self.participation(count))
        slopes = w * (np.sin(wl) + w * self.drag_length_mm * np.cos(wl))
        torque = -self.shaft.needle.rigidity_n_mm2 * c @ slopes
        return Response(time_s=t, tip_rad=u + c.sum(axis=1), base_torque_n_mm=torque, modes_rad=c)

"""Controllers of the tip: from a reference of the tip and an estimate to a base command.

    base only      base = reference
    compensator    base = reference + gain (reference - tip_hat)       the paper's overshoot
    LQR            d base/dt = -K (base - reference, c_1, c_2, ...)

where c_k are the modes of the base-driven needle (models.modes), in which the tip is
base + sum c_k, and K minimises the integral of (tip - reference)^2 + weight (d base/dt)^2.
Each law gives a base angle; `LimitedBase` saturates it to the limits of the motor.
"""

import math
from typing import Protocol

import control
import numpy as np
from numpy.typing import NDArray

from controllers.limits import LimitedBase, MotorLimits
from controllers.signals import Command, Estimate, Sample, Status
from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_GRID_MM = 2.0  # grid of lengths; one design for each


class Controller(Protocol):
    """Anything that turns a reference of the tip, deg, and an estimate into a base command."""

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """The command until the next sample."""

    def reset(self) -> None:
        """Forget everything before a new run."""


class BaseOnly:
    """Turns the base to the reference, as if the needle were rigid."""

    def __init__(self, limits: MotorLimits) -> None:
        self._base = LimitedBase(limits)

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """base = reference."""
        return self._base.toward(reference_deg, sample, estimate.status)


class Compensator:
    """The paper's torsion compensator: the base overshoots by the error of the tip.

    Args:
      gain: overshoot over the estimated error of the tip.

    Raises:
      InvalidValue: gain is negative.
    """

    def __init__(self, limits: MotorLimits, *, gain: float = 1.0) -> None:
        if not (math.isfinite(gain) and gain >= 0):
            raise InvalidValue("gain", gain, "a finite number of at least 0")
        self._base, self.gain = LimitedBase(limits), gain

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """base = reference + gain (reference - tip)."""
        target_deg = reference_deg + self.gain * (reference_deg - estimate.tip_deg)
        return self._base.toward(target_deg, sample, estimate.status)


class BaseModes:
    """Modes of the base-driven needle, from the modes and tip of an estimate.

    The lag theta - base along the shaft is known at the tip and, from the torque, in
    shape; its modes are those of the estimate, projected.
    """

    def __init__(self, held: InsertedNeedle, count: int, known: int) -> None:
        self.held = held
        self.poles = held.poles_rad_s(count)
        self.participation = held.participation(count)
        s = np.linspace(0.0, held.inserted_mm, 201)
        shapes = np.cos(np.outer(s, held.wavenumbers_per_mm(count)))
        k = np.arange(1, known + 1)
        past_tip = np.cos(np.outer(s, k * np.pi / held.inserted_mm)) - 1.0
        project = np.linalg.pinv(shapes)
        self._from_modes, self._from_tip = project @ past_tip, project @ np.ones(s.size)

    def lag_modes_rad(self, estimate: Estimate, base_deg: float) -> Array:
        """c_k, rad, from the estimated modes and tip."""
        modes = self._from_modes @ (estimate.modes_deg * _RAD)
        lag: Array = modes + self._from_tip * (estimate.tip_deg - base_deg) * _RAD
        return lag


class Regulator:
    """Linear-quadratic regulator of tip error against base rate.

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: beta of the design; the estimate's, where it has one.
      weight_s: weight of base rate: seconds of tip error that one rad/s is worth.
      order: modes of the base-driven needle in the design.

    Raises:
      InvalidValue: weight is not positive, or the order is below 1.
    """

    def __init__(
        self,
        needle: Needle,
        limits: MotorLimits,
        *,
        damping_n_mm_s_per_mm: float,
        weight_s: float = 0.02,
        order: int = 3,
    ) -> None:
        if not (math.isfinite(weight_s) and weight_s > 0):
            raise InvalidValue("weight_s", weight_s, "a finite number above 0")
        if order < 1:
            raise InvalidValue("order", order, "at least 1 mode")
        if not (math.isfinite(damping_n_mm_s_per_mm) and damping_n_mm_s_per_mm > 0):
            raise InvalidValue("damping_n_mm_s_per_mm", damping_n_mm_s_per_mm, "a finite number above 0")
        self.needle, self.damping, self.weight_s, self.order = (
            needle,
            damping_n_mm_s_per_mm,
            weight_s,
            order,
        )
        self._base = LimitedBase(limits)
        self._designs: dict[tuple[int, ...], tuple[BaseModes, Array]] = {}
        self.reset()

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()
        self._time_s = math.nan

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """d base/dt = -K (base - reference, c)."""
        if estimate.status is Status.OUTSIDE or estimate.modes_deg.size == 0:
            self._time_s = sample.time_s
            return self._base.toward(reference_deg, sample, estimate.status)
        base = self._base.base_deg if math.isfinite(self._base.base_deg) else sample.base_deg
        dt = sample.time_s - self._time_s if math.isfinite(self._time_s) else 0.0
        self._time_s = sample.time_s
        modes, gain = self.design(sample, estimate.modes_deg.size)
        state = np.concatenate(
            [[(base - reference_deg) * _RAD], modes.lag_modes_rad(estimate, sample.base_deg)]
        )
        rate_deg_s = -float(gain @ state) / _RAD
        return self._base.toward(base + rate_deg_s * dt, sample, estimate.status)

    def design(self, sample: Sample, known: int) -> tuple[BaseModes, Array]:
        """Modes and gain at these lengths; made once for every 2 mm."""
        inserted = max(_GRID_MM, _GRID_MM * round(sample.inserted_mm / _GRID_MM))
        free = _GRID_MM * round(sample.free_mm / _GRID_MM)
        key = (int(inserted), int(free), known)
        if key not in self._designs:
            held = InsertedNeedle(
                needle=self.needle,
                damping_n_mm_s_per_mm=self.damping,
                inserted_mm=inserted,
                free_mm=free,
                drive=DriveKind.ANGLE,
            )
            modes = BaseModes(held, self.order, known)
            self._designs[key] = modes, self._gain(modes)
        return self._designs[key]

    def _gain(self, modes: BaseModes) -> Array:
        a = np.diag(np.concatenate([[0.0], modes.poles]))
        b = np.concatenate([[1.0], -modes.participation])[:, None]
        tip = np.ones((1, a.shape[0]))
        gain, _, closed = control.lqr(a, b, tip.T @ tip, np.array([[self.weight_s**2]]))
        if not np.all(np.real(closed) < 0):
            raise InvalidValue("weight_s", self.weight_s, "a weight that gives a stable design")
        row: Array = np.asarray(gain)[0]
        return row

"""Linear-quadratic regulators of the tip.

    d command/dt = -K x

On an ideal drive x = (base - reference, c_1, c_2, ...) with the modes c_k of controllers.modal_lag,
and K minimises the integral of (tip - reference)^2 + weight^2 (d command/dt)^2.

The predictive regulator knows the delays of its loop. It applies K to the state that the needle will
have when the command arrives (controllers.prediction). If a servo turns the shaft, its angle and
rate are states too:

    x = (command - reference, shaft - reference, d shaft/dt, c_1, c_2, ...)
    shaft'' = w^2 (command - shaft) - 2 d w shaft',     dc_k/dt = p_k c_k - a_k shaft'

A known delay makes the tip later by that delay, and costs no stability. An unknown one remains
in the loop: the regulator has to be robust against the error of the assumed delay.
"""

import math

import control
import numpy as np
from numpy.typing import NDArray

from controllers.limits import LimitedBase, MotorLimits
from controllers.modal_lag import BaseModes
from controllers.prediction import LoopTiming, Predictor
from controllers.signals import Command, Estimate, Sample, Status
from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_GRID_MM = 2.0  # grid of lengths; one design for each
_GRID_LOG_DAMPING = 0.05  # grid of an identified damping, natural log
_MOST_LOG_DAMPING = 3.0  # no design beyond 20 times the assumed damping, or below 1/20


class Regulator:
    """Linear-quadratic regulator of tip error against base rate.

    Args:
      needle: the shaft.
      damping_n_mm_s_per_mm: beta of the design, unless the estimate brings its own.
      weight_s: weight of the base rate, s: one rad/s costs as much as a tip error of this many rad.
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
        self.needle, self.damping = needle, damping_n_mm_s_per_mm
        self.weight_s, self.order = weight_s, order
        self._base = LimitedBase(limits)
        self._designs: dict[tuple[int, ...], tuple[BaseModes, Array]] = {}
        self.reset()

    def reset(self) -> None:
        """Forget the last command."""
        self._base.reset()
        self._time_s = math.nan

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """d command/dt = -K x."""
        if estimate.status is Status.OUTSIDE or estimate.modes_deg.size == 0:
            self._time_s = sample.time_s
            return self._base.toward(reference_deg, sample, estimate.status)
        base = self._base.base_deg if math.isfinite(self._base.base_deg) else sample.base_deg
        dt = sample.time_s - self._time_s if math.isfinite(self._time_s) else 0.0
        self._time_s = sample.time_s
        modes, gain = self.design(sample, estimate)
        state = self._state(base, reference_deg, modes, sample, estimate)
        rate_deg_s = -float(gain @ state) / _RAD
        return self._base.toward(base + rate_deg_s * dt, sample, estimate.status)

    def design(self, sample: Sample, estimate: Estimate) -> tuple[BaseModes, Array]:
        """Modes and gain at these lengths and this damping, cached on a grid of 2 mm and 5 %."""
        inserted = max(_GRID_MM, _GRID_MM * round(sample.inserted_mm / _GRID_MM))
        free = _GRID_MM * round(sample.free_mm / _GRID_MM)
        level = self._damping_level(estimate.damping_n_mm_s_per_mm)
        key = (int(inserted), int(free), estimate.modes_deg.size, level)
        if key not in self._designs:
            held = InsertedNeedle(
                needle=self.needle,
                damping_n_mm_s_per_mm=self.damping * math.exp(_GRID_LOG_DAMPING * level),
                inserted_mm=inserted,
                free_mm=free,
                drive=DriveKind.ANGLE,
            )
            modes = BaseModes(held, self.order, estimate.modes_deg.size)
            self._designs[key] = modes, self._gain(modes)
        return self._designs[key]

    def _damping_level(self, identified: float) -> int:
        """Index of the identified damping on a grid of 5 %; 0 is the assumed damping."""
        if not (math.isfinite(identified) and identified > 0):
            return 0
        off = math.log(identified / self.damping)
        return round(min(max(off, -_MOST_LOG_DAMPING), _MOST_LOG_DAMPING) / _GRID_LOG_DAMPING)

    def _state(
        self,
        base_deg: float,
        reference_deg: float,
        modes: BaseModes,
        sample: Sample,
        estimate: Estimate,
    ) -> Array:
        lag = modes.lag_modes_rad(estimate, sample.base_deg)
        return np.concatenate([[(base_deg - reference_deg) * _RAD], lag])

    def _gain(self, modes: BaseModes) -> Array:
        a, b, tip = self._system(modes)
        gain, _, closed = control.lqr(a, b, tip.T @ tip, np.array([[self.weight_s**2]]))
        if not np.all(np.real(closed) < 0):
            raise InvalidValue(
                "weight_s",
                self.weight_s,
                "a weight that gives a stable design",
                "choose one nearer to the default, 0.02 s",
            )
        row: Array = np.asarray(gain)[0]
        return row

    def _system(self, modes: BaseModes) -> tuple[Array, Array, Array]:
        """A, B and the output row of the tip for the states of the module's docstring."""
        a = np.diag(np.concatenate([[0.0], modes.poles]))
        b = np.concatenate([[1.0], -modes.participation])[:, None]
        return a, b, np.ones((1, a.shape[0]))


class PredictiveRegulator(Regulator):
    """The regulator for a loop with known delays and a servo; see the module.

    Args:
      timing: of sensors and drive.
    """

    def __init__(
        self,
        needle: Needle,
        limits: MotorLimits,
        timing: LoopTiming,
        *,
        damping_n_mm_s_per_mm: float,
        weight_s: float = 0.02,
        order: int = 3,
    ) -> None:
        self._predictor = Predictor(timing)
        super().__init__(
            needle, limits, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm, weight_s=weight_s, order=order
        )

    def reset(self) -> None:
        """Forget all commands."""
        super().reset()
        self._predictor.reset()

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """d command/dt = -K x, with the state at the time when the command arrives."""
        if sample.usable():
            self._predictor.advance(sample.time_s, sample.base_deg)
        command = super().command(reference_deg, sample, estimate)
        self._predictor.send(command.base_deg)
        return command

    def _state(
        self,
        base_deg: float,
        reference_deg: float,
        modes: BaseModes,
        sample: Sample,
        estimate: Estimate,
    ) -> Array:
        late = modes.lag_modes_rad(estimate, sample.base_deg)
        ahead = self._predictor.predict(modes, late, sample.base_deg)
        commanded = (base_deg - reference_deg) * _RAD
        if self._predictor.timing.servo is None:
            return np.concatenate([[commanded], ahead.lag_modes_rad])
        shaft = (ahead.shaft_deg - reference_deg) * _RAD
        rate = ahead.shaft_rate_deg_s * _RAD
        return np.concatenate([[commanded, shaft, rate], ahead.lag_modes_rad])

    def _system(self, modes: BaseModes) -> tuple[Array, Array, Array]:
        servo = self._predictor.timing.servo
        if servo is None:
            return super()._system(modes)
        a = np.diag(np.concatenate([np.zeros(3), modes.poles]))
        a[1:3, 1:3] = servo.matrix
        a[2, 0] = servo.rate_rad_s**2
        a[3:, 2] = -modes.participation
        b = np.zeros((a.shape[0], 1))
        b[0] = 1.0
        tip = np.ones((1, a.shape[0]))
        tip[0, [0, 2]] = 0.0
        return a, b, tip

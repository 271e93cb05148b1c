"""Tip controllers by name: estimator and control law, combined for `sim.closed_loop`."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from controllers.adaptive import AdaptiveEstimator
from controllers.estimators import (
    Estimator,
    FeedforwardEstimator,
    LuenbergerEstimator,
    OutputEquation,
)
from controllers.friction import FrictionAware
from controllers.laws import BaseOnly, Compensator, Controller
from controllers.least_time import LeastTime
from controllers.limits import MotorLimits, rigid_needle_estimate
from controllers.prediction import LoopTiming
from controllers.regulator import PredictiveRegulator, Regulator
from controllers.signals import Command, Estimate, Sample
from models.errors import UnknownName
from models.needle import Needle
from sim.closed_loop import Measurement

# The paper turns the base alone by 90 deg in about 0.3 s; its compensators may use
# whatever the motor can do, which it does not state.
BASE_ONLY_RATE_DEG_S = 300.0
COMPENSATOR_GAIN = 1.5
_BIAS_DRIFT_N_MM = 0.002  # in a root second: a sensor's zero that wanders by 0.015 N mm a minute


@dataclass
class TipController:
    """Output feedback: an estimator of the tip, and a control law on the estimate.

    It keeps the last estimate and command for the log.

    Attributes:
      law: computes a base command from reference and estimate.
      estimator: None: the tip is assumed to have the angle of the base.
      uses_tip_sensor: whether the estimator receives the measured tip angle.
      advance_mm: axial motion in addition to the scheduled one, mm.
    """

    law: Controller
    estimator: Estimator | None
    uses_tip_sensor: bool = False
    _command: Command = field(default_factory=lambda: Command(0.0))
    _estimate: Estimate = field(default_factory=lambda: Estimate(0.0))
    advance_mm: float = 0.0

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """The base angle for the next step, deg."""
        sample = Sample(
            measurement.time_s,
            measurement.base_deg,
            measurement.torque_n_mm,
            measurement.inserted_mm,
            measurement.free_mm,
            measurement.tip_deg if self.uses_tip_sensor else None,
        )
        self._estimate = (
            self.estimator.update(sample) if self.estimator else rigid_needle_estimate(sample)
        )
        self._command = self.law.command(reference_deg, sample, self._estimate)
        self.advance_mm = self._command.advance_mm
        return self._command.base_deg

    def reset(self) -> None:
        """Go back to the state before the first sample, in law and estimator."""
        self.law.reset()
        if self.estimator is not None:
            self.estimator.reset()
        self._command, self._estimate, self.advance_mm = Command(0.0), Estimate(0.0), 0.0

    @property
    def estimated_tip_deg(self) -> float:
        """The last estimate of the tip, deg."""
        return self._estimate.tip_deg

    def signals(self) -> dict[str, float]:
        """Estimate, command and limits of the last sample, by name."""
        modes = self._estimate.modes_deg
        signals = {
            "estimate_tip_deg": self._estimate.tip_deg,
            "command_base_deg": self._command.base_deg,
            "rate_limited_count": float(self._command.rate_limited),
            "torque_limited_count": float(self._command.torque_limited),
            "estimate_damping_n_mm_s_per_mm": self._estimate.damping_n_mm_s_per_mm,
        }
        if isinstance(self.estimator, AdaptiveEstimator):
            signals["estimate_bias_n_mm"] = self.estimator.torque_bias_n_mm
        kept = {k: 0.0 if math.isnan(v) else v for k, v in signals.items()}
        return kept | {f"estimate_mode_{i + 1}_deg": float(m) for i, m in enumerate(modes)}


@dataclass(frozen=True, kw_only=True)
class ControllerDesign:
    """What a tip controller is designed for: a model, a motor, and the sensors of a loop.

    Attributes:
      needle, damping_n_mm_s_per_mm: parameters of the modal model.
      limits: limits of the motor.
      order: number of modes of the estimator, including mode 0.
      timing: delays and servo, as the predictive controllers know them.
      base_noise_deg, torque_noise_n_mm: noise that the adaptive estimators assume.
      bias_spread_n_mm: standard deviation of the torque bias, for estimators that identify it.
    """

    needle: Needle
    damping_n_mm_s_per_mm: float
    limits: MotorLimits = MotorLimits()  # noqa: RUF009 - frozen
    order: int = 4
    timing: LoopTiming = LoopTiming()  # noqa: RUF009 - frozen
    base_noise_deg: float = 0.05
    torque_noise_n_mm: float = 0.015
    bias_spread_n_mm: float = 0.2


def _feedforward(design: ControllerDesign) -> Estimator:
    return FeedforwardEstimator(
        design.needle, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm, order=design.order
    )


def _paper_output(design: ControllerDesign) -> TipController:
    estimator = FeedforwardEstimator(
        design.needle,
        damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm,
        order=design.order,
        output=OutputEquation.PAPER,
    )
    return TipController(Compensator(design.limits, gain=COMPENSATOR_GAIN), estimator)


def _base_only(design: ControllerDesign) -> TipController:
    rate = min(BASE_ONLY_RATE_DEG_S, design.limits.rate_deg_s)
    return TipController(BaseOnly(design.limits.but(rate_deg_s=rate)), None)


def _observer(design: ControllerDesign) -> LuenbergerEstimator:
    return LuenbergerEstimator(
        design.needle, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm, order=design.order
    )


def _feedback(design: ControllerDesign) -> TipController:
    law = Compensator(design.limits, gain=COMPENSATOR_GAIN)
    return TipController(law, _observer(design), uses_tip_sensor=True)


def _identifying(
    design: ControllerDesign, *, bias_spread_n_mm: float = 0.0, bias_drift_n_mm: float = 0.0
) -> AdaptiveEstimator:
    return AdaptiveEstimator(
        design.needle,
        damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm,
        order=design.order,
        base_noise_deg=design.base_noise_deg,
        torque_noise_n_mm=design.torque_noise_n_mm,
        bias_spread_n_mm=bias_spread_n_mm,
        bias_drift_n_mm=bias_drift_n_mm,
    )


def _adaptive(design: ControllerDesign) -> TipController:
    return TipController(Compensator(design.limits, gain=COMPENSATOR_GAIN), _identifying(design))


def _unbiased(design: ControllerDesign) -> TipController:
    estimator = _identifying(design, bias_spread_n_mm=design.bias_spread_n_mm)
    return TipController(Compensator(design.limits, gain=COMPENSATOR_GAIN), estimator)


def _bias_tracking(design: ControllerDesign) -> TipController:
    estimator = _identifying(
        design, bias_spread_n_mm=design.bias_spread_n_mm, bias_drift_n_mm=_BIAS_DRIFT_N_MM
    )
    return TipController(Compensator(design.limits, gain=COMPENSATOR_GAIN), estimator)


def _predictive_law(design: ControllerDesign) -> PredictiveRegulator:
    return PredictiveRegulator(
        design.needle,
        design.limits,
        design.timing,
        damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm,
    )


def _predictive(design: ControllerDesign) -> TipController:
    return TipController(_predictive_law(design), _feedforward(design))


def _predictive_unbiased(design: ControllerDesign) -> TipController:
    estimator = _identifying(design, bias_spread_n_mm=design.bias_spread_n_mm)
    return TipController(_predictive_law(design), estimator)


def _predictive_feedback(design: ControllerDesign) -> TipController:
    return TipController(_predictive_law(design), _observer(design), uses_tip_sensor=True)


def _friction_aware_feedback(design: ControllerDesign) -> TipController:
    return TipController(FrictionAware(design.limits), _observer(design), uses_tip_sensor=True)


def _lqr(design: ControllerDesign) -> TipController:
    regulator = Regulator(
        design.needle, design.limits, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm
    )
    return TipController(regulator, _feedforward(design))


def _least_time(design: ControllerDesign) -> TipController:
    planner = LeastTime(design.needle, design.limits, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm)
    return TipController(planner, _feedforward(design))


TIP_CONTROLLERS: dict[str, Callable[[ControllerDesign], TipController]] = {
    "base_only": _base_only,
    "base_only_at_limit": lambda d: TipController(BaseOnly(d.limits), None),
    "feedforward": lambda d: TipController(
        Compensator(d.limits, gain=COMPENSATOR_GAIN), _feedforward(d)
    ),
    "feedback": _feedback,
    "paper_reading": _paper_output,
    "adaptive": _adaptive,
    "lqr": _lqr,
    "least_time": _least_time,
    "unbiased": _unbiased,
    "bias_tracking": _bias_tracking,
    "predictive": _predictive,
    "predictive_unbiased": _predictive_unbiased,
    "predictive_feedback": _predictive_feedback,
    "friction_aware": lambda d: TipController(FrictionAware(d.limits), _feedforward(d)),
    "friction_aware_feedback": _friction_aware_feedback,
}


def tip_controller_named(name: str, design: ControllerDesign) -> TipController:
    """A tip controller by name.

    Raises:
      UnknownName: lists the known names.
    """
    if name not in TIP_CONTROLLERS:
        raise UnknownName("controller", name, TIP_CONTROLLERS)
    return TIP_CONTROLLERS[name](design)

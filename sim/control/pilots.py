"""Estimator and controller together, by name, as a pilot of `sim.closed_loop`."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from controllers.adaptive import AdaptiveEstimator
from controllers.estimators import (
    Estimator,
    FeedforwardEstimator,
    LuenbergerEstimator,
)
from controllers.estimators import (
    Reading as TipReading,
)
from controllers.friction import FrictionAware
from controllers.laws import BaseOnly, Compensator, Controller, Regulator
from controllers.least_time import LeastTime
from controllers.limits import MotorLimits, blind
from controllers.signals import Command, Estimate, Sample
from models.errors import UnknownName
from models.needle import Needle
from sim.closed_loop import Reading

# The paper turns the base alone by 90 deg in about 0.3 s; its compensators may use
# whatever the motor can do, which it does not state.
BASE_ONLY_RATE_DEG_S = 300.0
COMPENSATOR_GAIN = 1.5


@dataclass
class Pilot:
    """An estimator and a controller in one loop; the last of each is kept for the log."""

    controller: Controller
    estimator: Estimator | None
    sees_tip: bool = False
    _command: Command = field(default_factory=lambda: Command(0.0))
    _estimate: Estimate = field(default_factory=lambda: Estimate(0.0))
    advance_mm: float = 0.0

    def __call__(self, reading: Reading, wanted_deg: float) -> float:
        """The base angle for the next step, deg."""
        sample = Sample(
            reading.time_s,
            reading.base_deg,
            reading.torque_n_mm,
            reading.inserted_mm,
            reading.free_mm,
            reading.tip_deg if self.sees_tip else None,
        )
        self._estimate = self.estimator.update(sample) if self.estimator else blind(sample)
        self._command = self.controller.command(wanted_deg, sample, self._estimate)
        self.advance_mm = self._command.advance_mm
        return self._command.base_deg

    @property
    def estimated_tip_deg(self) -> float:
        """What the pilot takes the tip to be."""
        return self._estimate.tip_deg

    def log(self) -> dict[str, float]:
        """Estimate, command and limits of the last sample, as signals."""
        modes = self._estimate.modes_deg
        signals = {
            "estimate_tip_deg": self._estimate.tip_deg,
            "command_base_deg": self._command.base_deg,
            "rate_limited_count": float(self._command.rate_limited),
            "torque_limited_count": float(self._command.torque_limited),
            "estimate_damping_n_mm_s_per_mm": self._estimate.damping_n_mm_s_per_mm,
        }
        kept = {k: 0.0 if math.isnan(v) else v for k, v in signals.items()}
        return kept | {f"estimate_mode_{i + 1}_deg": float(m) for i, m in enumerate(modes)}


@dataclass(frozen=True, kw_only=True)
class Design:
    """What a pilot is designed with."""

    needle: Needle
    damping_n_mm_s_per_mm: float
    limits: MotorLimits = MotorLimits()  # noqa: RUF009 - frozen
    order: int = 4


def _feedforward(design: Design) -> Estimator:
    return FeedforwardEstimator(
        design.needle, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm, order=design.order
    )


def _paper_reading(design: Design) -> Pilot:
    estimator = FeedforwardEstimator(
        design.needle,
        damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm,
        order=design.order,
        reading=TipReading.PAPER,
    )
    return Pilot(Compensator(design.limits, gain=COMPENSATOR_GAIN), estimator)


def _base_only(design: Design) -> Pilot:
    rate = min(BASE_ONLY_RATE_DEG_S, design.limits.rate_deg_s)
    return Pilot(BaseOnly(design.limits.but(rate_deg_s=rate)), None)


def _feedback(design: Design) -> Pilot:
    observer = LuenbergerEstimator(
        design.needle, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm, order=design.order
    )
    return Pilot(Compensator(design.limits, gain=COMPENSATOR_GAIN), observer, sees_tip=True)


def _adaptive(design: Design) -> Pilot:
    estimator = AdaptiveEstimator(
        design.needle, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm, order=design.order
    )
    return Pilot(Compensator(design.limits, gain=COMPENSATOR_GAIN), estimator)


def _lqr(design: Design) -> Pilot:
    regulator = Regulator(
        design.needle, design.limits, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm
    )
    return Pilot(regulator, _feedforward(design))


def _least_time(design: Design) -> Pilot:
    planner = LeastTime(design.needle, design.limits, damping_n_mm_s_per_mm=design.damping_n_mm_s_per_mm)
    return Pilot(planner, _feedforward(design))


PILOTS: dict[str, Callable[[Design], Pilot]] = {
    "base_only": _base_only,
    "base_only_at_limit": lambda d: Pilot(BaseOnly(d.limits), None),
    "feedforward": lambda d: Pilot(Compensator(d.limits, gain=COMPENSATOR_GAIN), _feedforward(d)),
    "feedback": _feedback,
    "paper_reading": _paper_reading,
    "adaptive": _adaptive,
    "lqr": _lqr,
    "least_time": _least_time,
    "friction_aware": lambda d: Pilot(FrictionAware(d.limits), _feedforward(d)),
}


def pilot_named(name: str, design: Design) -> Pilot:
    """A pilot by name.

    Raises:
      UnknownName: lists the known names.
    """
    if name not in PILOTS:
        raise UnknownName("controller", name, PILOTS)
    return PILOTS[name](design)

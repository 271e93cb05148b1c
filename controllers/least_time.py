"""The controller that brings the tip to its reference in the least time that the motor allows.

When the reference jumps, a linear program plans the rates of the base. The tip, which is
linear in them, has to stay within `band` of the reference from some time on, and may never
overshoot by more than that; base rate and torque stay within the motor's limits. Bisection
finds the earliest such time; among the plans that reach it, the program chooses the one with
the smallest integral of tip error. The base follows the plan, corrected by the deviation of
the estimate from it. When the plan has ended, a regulator holds the tip. If the tip does
not follow the plan, its model is wrong: the plan is dropped, and the compensator takes over.
"""

import math

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import linprog

from controllers.laws import Compensator
from controllers.limits import LimitedBase, MotorLimits
from controllers.modal_lag import BaseModes
from controllers.regulator import Regulator
from controllers.signals import Command, Estimate, Sample, Status
from models.drive import DriveKind
from models.errors import InvalidValue
from models.modes import InsertedNeedle
from models.needle import Needle

Array = NDArray[np.float64]

_RAD = math.pi / 180.0
_MODES = 10
_LEAST_TURN_DEG = 3.0  # smaller steps are left to the regulator
_MOST_DEVIATION_DEG = 5.0  # of the estimate from the plan; beyond it the plan is dropped
_MOVING = 0.7  # share of the plan in which the base may move; the rest shows what follows


class LeastTime:
    """Plans the base motion by linear programming; see the module.

    Args:
      damping_n_mm_s_per_mm: beta of the plan; an estimator that identifies beta replaces it.
      band_deg: how near the tip has to come, and how far it may overshoot.
      steps: number of steps of the plan.

    Raises:
      InvalidValue: the band is not positive, or the plan has fewer than 10 steps.
    """

    def __init__(
        self,
        needle: Needle,
        limits: MotorLimits,
        *,
        damping_n_mm_s_per_mm: float,
        band_deg: float = 2.0,
        steps: int = 120,
    ) -> None:
        if not (math.isfinite(band_deg) and band_deg > 0):
            raise InvalidValue("band_deg", band_deg, "a finite number above 0")
        if steps < 10:
            raise InvalidValue("steps", steps, "at least 10")
        self.needle, self.limits, self.band_deg, self.steps = needle, limits, band_deg, steps
        self.damping = damping_n_mm_s_per_mm
        self._base = LimitedBase(limits)
        self._fallback = Compensator(limits, gain=1.5)
        self._regulator = Regulator(needle, limits, damping_n_mm_s_per_mm=damping_n_mm_s_per_mm)
        self.reset()

    def reset(self) -> None:
        """Forget the plan and the last command."""
        self._base.reset()
        self._regulator.reset()
        self._fallback.reset()
        self._plan_dropped = False
        self._plan: Plan | None = None
        self._reference_deg = self._planned_deg = math.nan

    def command(self, reference_deg: float, sample: Sample, estimate: Estimate) -> Command:
        """Follow the plan; make a new one if the reference has jumped."""
        if estimate.status not in (Status.OK, Status.OUTSIDE) or not math.isfinite(reference_deg):
            return self._base.toward(reference_deg, sample, estimate.status)
        if estimate.status is Status.OUTSIDE:
            self._reference_deg = math.nan
            return self._base.toward(reference_deg, sample, estimate.status)
        # Only a reference that jumps is planned for; one that moves slowly is followed.
        if not abs(reference_deg - self._reference_deg) < _LEAST_TURN_DEG:
            self._planned_deg = reference_deg
            self._plan = self._planned(reference_deg, sample, estimate)
            self._plan_dropped = False
            self._regulator.reset()
        elif abs(reference_deg - self._planned_deg) >= _LEAST_TURN_DEG:
            self._plan = None
        self._reference_deg = reference_deg
        if self._plan_dropped:
            return self._fallback.command(reference_deg, sample, estimate)
        if self._plan is None or sample.time_s >= self._plan.end_s:
            return self._regulator.command(reference_deg, sample, estimate)
        base, tip = self._plan.at(sample.time_s)
        if abs(tip - estimate.tip_deg) > _MOST_DEVIATION_DEG:
            self._plan_dropped = True
            self._fallback.reset()
            return self._fallback.command(reference_deg, sample, estimate)
        # The deviation of the estimate from the planned tip is added to the base.
        return self._base.toward(base + (tip - estimate.tip_deg), sample, estimate.status)

    def _planned(self, reference_deg: float, sample: Sample, estimate: Estimate) -> "Plan | None":
        if abs(reference_deg - estimate.tip_deg) < _LEAST_TURN_DEG:
            return None
        learnt = estimate.damping_n_mm_s_per_mm
        held = InsertedNeedle(
            needle=self.needle,
            damping_n_mm_s_per_mm=learnt if math.isfinite(learnt) else self.damping,
            inserted_mm=sample.inserted_mm,
            free_mm=sample.free_mm,
            drive=DriveKind.ANGLE,
        )
        modes = BaseModes(held, _MODES, estimate.modes_deg.size)
        base = self._base.base_deg if math.isfinite(self._base.base_deg) else sample.base_deg
        lag = modes.lag_modes_rad(estimate, sample.base_deg) / _RAD
        return plan(
            modes,
            start_s=sample.time_s,
            base_deg=base,
            lag_deg=lag,
            reference_deg=reference_deg,
            limits=self.limits,
            band_deg=self.band_deg,
            steps=self.steps,
        )


class Plan:
    """A base motion and the tip motion that it causes, at equal steps."""

    def __init__(
        self, start_s: float, step_s: float, base_deg: Array, tip_deg: Array, settling_s: float
    ) -> None:
        self.times_s = start_s + step_s * np.arange(base_deg.size)
        self.base_deg, self.tip_deg = base_deg, tip_deg
        self.end_s = float(self.times_s[-1])
        self.settling_s = settling_s
        """Time from the start after which the tip stays within the band."""

    def at(self, time_s: float) -> tuple[float, float]:
        """Base and tip angle at a time, deg."""
        return (
            float(np.interp(time_s, self.times_s, self.base_deg)),
            float(np.interp(time_s, self.times_s, self.tip_deg)),
        )


def plan(
    modes: BaseModes,
    *,
    start_s: float,
    base_deg: float,
    lag_deg: Array,
    reference_deg: float,
    limits: MotorLimits,
    band_deg: float,
    steps: int,
) -> Plan | None:
    """The base motion that settles the tip soonest; None if none settles it within the horizon."""
    horizon = _horizon_s(
        modes, abs(reference_deg - base_deg) + float(np.abs(lag_deg).sum()), limits, band_deg
    )
    dt = horizon / steps
    free, response = _tip(modes, base_deg, lag_deg, dt, steps)
    torque_free, torque_response = _torque(modes, lag_deg, dt, steps)
    problem = _LinearProgram(
        free, response, torque_free, torque_response, reference_deg, limits, band_deg, dt
    )
    first, last = 0, steps - 1
    if problem.rates(last) is None:
        return None
    while last - first > 1:
        middle = (first + last) // 2
        first, last = (first, middle) if problem.rates(middle) is not None else (middle, last)
    rates = problem.rates(last)
    if rates is None:
        return None
    base = base_deg + dt * np.concatenate([[0.0], np.cumsum(rates)])
    tip = np.concatenate([[base_deg + lag_deg.sum()], free + response @ rates])
    return Plan(start_s, dt, base, tip, (last + 1) * dt)


def _horizon_s(modes: BaseModes, turn_deg: float, limits: MotorLimits, band_deg: float) -> float:
    """Horizon of a plan, s: the base alone would settle in it, plus a turn there and back."""
    settle = math.log(max(turn_deg, 2 * band_deg) / band_deg) / abs(float(modes.poles[0]))
    return min(settle, 4.0) + 3 * turn_deg / limits.rate_deg_s


def _tip(
    modes: BaseModes, base_deg: float, lag_deg: Array, dt: float, steps: int
) -> tuple[Array, Array]:
    """Tip at the ends of the steps with the base at rest, (steps,), and its response to rates."""
    j = np.arange(1, steps + 1)
    decay = np.exp(np.outer(j, modes.poles) * dt)
    pulse = -modes.participation * np.expm1(modes.poles * dt) / modes.poles
    kernel = dt + np.exp(np.outer(j - 1, modes.poles) * dt) @ pulse
    response = np.tril(kernel[np.abs(np.subtract.outer(j, j))])
    return base_deg + decay @ lag_deg, response


def _torque(modes: BaseModes, lag_deg: Array, dt: float, steps: int) -> tuple[Array, Array]:
    """Base torque at the ends of the steps, N mm, as `_tip`."""
    held = modes.held
    w = held.wavenumbers_per_mm(modes.poles.size)
    shape = -held.needle.rigidity_n_mm2 * w * np.sin(w * held.inserted_mm) * _RAD
    j = np.arange(1, steps + 1)
    decay = np.exp(np.outer(j, modes.poles) * dt)
    pulse = -modes.participation * np.expm1(modes.poles * dt) / modes.poles
    kernel = np.exp(np.outer(j - 1, modes.poles) * dt) @ (pulse * shape)
    return decay @ (lag_deg * shape), np.tril(kernel[np.abs(np.subtract.outer(j, j))])


class _LinearProgram:
    """min sum |reference - tip| over base rates, with the tip within the band from a step on."""

    def __init__(
        self,
        free: Array,
        response: Array,
        torque_free: Array,
        torque_response: Array,
        reference_deg: float,
        limits: MotorLimits,
        band_deg: float,
        dt: float,
    ) -> None:
        n = free.size
        self._side = 1.0 if reference_deg >= float(free[0]) else -1.0
        self._error = reference_deg - free
        self._band, self._n = band_deg, n
        moving = int(_MOVING * n)
        rate = limits.rate_deg_s
        self._moves = [(-rate, rate)] * moving + [(0.0, 0.0)] * (n - moving)
        one, none = np.eye(n), np.zeros((n, n))
        # unknowns: rates, then |error|; the tip overshoots by the band at most
        self._matrix = np.block(
            [
                [response, -one],
                [-response, -one],
                [torque_response, none],
                [-torque_response, none],
                [self._side * response, none],
            ]
        )
        self._bound = np.concatenate(
            [
                self._error,
                -self._error,
                limits.most_torque_n_mm - torque_free,
                limits.most_torque_n_mm + torque_free,
                self._side * self._error + band_deg,
            ]
        )
        self._cost = np.concatenate([np.zeros(n), np.full(n, dt)])

    def rates(self, settled: int) -> Array | None:
        """Base rates, deg/s, with the tip within the band from step `settled` on; None: impossible."""
        error_limit = np.full(self._n, np.inf)
        error_limit[settled:] = self._band
        solution = linprog(
            self._cost,
            A_ub=self._matrix,
            b_ub=self._bound,
            bounds=[*self._moves, *((0.0, float(e)) for e in error_limit)],
            method="highs",
        )
        if solution.status != 0 or solution.x is None:
            return None
        return np.asarray(solution.x[: self._n], np.float64)

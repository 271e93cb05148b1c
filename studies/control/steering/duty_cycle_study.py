"""Duty-cycled spinning of the needle: curvature over duty, and the influence of torsion on it.

The reference of the tip holds and spins while the needle is inserted by 4 cm. The base follows
the reference, or is turned by the compensator with the torsion estimator.
"""

import cmath
import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controllers.steering.duty_cycle import DutyCycle, mean_pull
from models.materials import MATERIALS
from sim.closed_loop import run_closed_loop
from sim.schedule import Schedule
from studies.control.steering.insertion_setup import constant_speed, lagrangian_setup
from studies.control.tables import DESIGN
from studies.control.tip_controllers import tip_controller_named

Array = NDArray[np.float64]

DUTIES = (0.0, 0.25, 0.5, 0.75, 1.0)
START_DEPTHS_MM = (20.0, 100.0)
DUTY_CASES = {"torsion left out": "base_only_at_limit", "torsion compensated": "feedforward"}
_TRAVEL_MM, _SPEED_MM_S, _FREE_MM = 40.0, 2.5, 50.0
_STEP_S, _ELEMENTS = 0.01, 24


@dataclass(frozen=True, kw_only=True)
class SpunCurvature:
    """One insertion with spinning.

    Attributes:
      case: one of `DUTY_CASES`.
      start_mm: depth at the start.
      duty: share of the time in which the reference spins.
      share: curvature / curvature of a held tip; the law gives 1 - duty.
      direction_deg: direction of the curvature relative to the held roll; NaN if `share` is below 0.05.
    """

    case: str
    start_mm: float
    duty: float
    share: float
    direction_deg: float


def spun_curvatures(
    duties: Sequence[float] = DUTIES, *, start_depths_mm: Sequence[float] = START_DEPTHS_MM
) -> list[SpunCurvature]:
    """Every case, depth and duty."""
    return [
        spin(case, duty, start_mm=depth)
        for case in DUTY_CASES
        for depth in start_depths_mm
        for duty in duties
    ]


def spin(case: str, duty: float, *, start_mm: float) -> SpunCurvature:
    """One insertion; the first cycle, in which the lag builds up, is left out."""
    cycle = DutyCycle(duty=duty)
    inputs = _reference(cycle, start_mm)
    setup = lagrangian_setup(
        MATERIALS["viscous-plastisol"],
        free_mm=float(inputs.free_mm[0]),
        inserted_mm=start_mm,
        step_s=_STEP_S,
        elements=_ELEMENTS,
    )
    controller = tip_controller_named(DUTY_CASES[case], DESIGN)
    run = run_closed_loop(setup, inputs, controller).run
    counted = _whole_cycles(run.time_s, cycle)
    pull = mean_pull(np.radians(run.tip_deg[counted]), run.inputs.inserted_mm[counted])
    direction = math.degrees(cmath.phase(pull)) if abs(pull) > 0.05 else math.nan
    return SpunCurvature(
        case=case, start_mm=start_mm, duty=duty, share=abs(pull), direction_deg=direction
    )


def _reference(cycle: DutyCycle, start_mm: float) -> Schedule:
    """An insertion whose reference holds and spins."""
    still = constant_speed(
        start_mm=start_mm, travel_mm=_TRAVEL_MM, speed_mm_s=_SPEED_MM_S, free_mm=_FREE_MM
    ).at_steps(_STEP_S)
    return Schedule(
        time_s=still.time_s,
        drive=np.array([cycle.roll_deg(float(t)) for t in still.time_s]),
        free_mm=still.free_mm,
        inserted_mm=still.inserted_mm,
        speed_mm_s=still.speed_mm_s,
    )


def _whole_cycles(time_s: Array, cycle: DutyCycle) -> slice:
    """Samples of all complete cycles but the first; all samples if the tip never spins."""
    if math.isinf(cycle.period_s):
        return slice(None)
    cycles = math.floor(time_s[-1] / cycle.period_s + 1e-9)
    first, last = np.searchsorted(time_s, np.array([1, cycles]) * cycle.period_s - 1e-9)
    return slice(int(first), int(last) + 1)

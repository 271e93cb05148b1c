"""The quantities of a simulated run, as the paper would have read them."""

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.sensing.sensors import sensed
from sim.needles.run import Run
from studies.crosscheck.paper import INTEGRAL_S, SETTLED_DEG, integral_deg_s
from studies.published.experiments.base_turn import TURN_DEG
from studies.published.experiments.measurement import Quantity, TurnExperiment
from studies.published.experiments.rig import PublishedRig
from studies.published.experiments.schedules import AT_REST, TurnAtRest

Array = NDArray[np.float64]
Quantities = dict[Quantity, float]

_ROUNDING_S = 1e-9


def read_off(experiment: TurnExperiment, run: Run, rig: PublishedRig) -> Quantities:
    """Quantities of a run of an experiment, as the paper would have read them, in their units."""
    drive = run.inputs.drive
    tip, torque = sensed(rig.model, run.inputs, run.tip_deg, run.base_torque_n_mm)
    if experiment is TurnExperiment.QUICK_TURN:
        return _of_quick_turn(run.time_s, TURN_DEG - tip)
    return _of_turn_at_rest(AT_REST[experiment], run.time_s, drive - tip, torque)


def _of_quick_turn(time_s: Array, error_deg: Array) -> Quantities:
    return {
        Quantity.SETTLING: interpolated_settling_s(time_s, error_deg),
        Quantity.ERROR_LEFT: float(error_deg[-1]),
        Quantity.INTEGRAL: integral_deg_s(time_s, error_deg, INTEGRAL_S),
    }


def _of_turn_at_rest(turn: TurnAtRest, time_s: Array, lag_deg: Array, torque: Array) -> Quantities:
    half, turned, held = (
        int(np.searchsorted(time_s, t - _ROUNDING_S))
        for t in (turn.turn_s / 2, turn.turn_s, turn.turn_s + turn.held_s)
    )
    rate_rad_s = np.radians(TURN_DEG / turn.turn_s)
    values = {
        Quantity.DAMPING: float(torque[half : turned + 1].mean() / rate_rad_s),
        Quantity.LAG: float(lag_deg[turned]),
    }
    if turn.held_s:
        values[Quantity.HELD_TORQUE] = float(torque[turned : held + 1].mean())
    if turn.retracts:
        values[Quantity.LAG_LEFT] = float(lag_deg[-1] / lag_deg[held]) if lag_deg[held] else 0.0
    return values


def interpolated_settling_s(time_s: Array, error_deg: Array) -> float:
    """Time after which the error stays within 3 deg, s; interpolated, and so smooth in the error.

    If the error is still outside at the end, the result lies beyond the last of `time_s`, the
    further the larger the error is: a fit thus has a slope to follow.
    """
    size = np.abs(error_deg)
    outside = np.flatnonzero(size > SETTLED_DEG)
    if outside.size == 0:
        return 0.0
    last = int(outside[-1])
    if last == size.size - 1:
        return float(time_s[-1] * (1 + np.log(size[-1] / SETTLED_DEG)))
    share = (size[last] - SETTLED_DEG) / (size[last] - size[last + 1])
    return float(time_s[last] + share * (time_s[last + 1] - time_s[last]))

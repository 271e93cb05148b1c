"""The paper's experiments as inputs of the MuJoCo needle, and how it reads them off."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.paper.figures import Experiment, Measure
from diagnosis.paper.rig import TURN_DEG, PaperRig
from sim.schedule import Schedule
from sim.simulation import Run
from studies.crosscheck.paper import INTEGRAL_S, SETTLED_DEG, integral_deg_s

Array = NDArray[np.float64]
Readings = dict[Measure, float]

_SLOW_FREE_MM = 230.0
_SPEED_MM_S = -2.5  # of the quick turn
_WATCHED_S, _WATCHED_S_PER_MM = 2.5, 0.03  # of a quick turn: at least, and by depth
_RETRACT_MM, _RETRACT_S, _REST_S = 5.0, 1.0, 4.0
_JUMP_S = 1e-6
_TIE_S = 1e-9


@dataclass(frozen=True, kw_only=True)
class TurnAtRest:
    """90 deg at a constant rate without axial motion; then held; then, perhaps, retracted."""

    turn_s: float = 20.0
    held_s: float = 0.0
    retracts: bool = False


_AT_REST = {
    Experiment.SLOW_TURN: TurnAtRest(),
    Experiment.BRISK_TURN: TurnAtRest(turn_s=2.0),
    Experiment.HELD_TURN: TurnAtRest(held_s=10.0),
    Experiment.RELEASE: TurnAtRest(held_s=10.0, retracts=True),
}
# With four elements these steps leave less than a twentieth of any figure's spread.
STEP_S = {Experiment.QUICK_TURN: 0.025, Experiment.BRISK_TURN: 0.02}
SLOW_STEP_S = 0.1
ELEMENTS = 4


def schedule(experiment: Experiment, depth_mm: float, rig: PaperRig) -> Schedule:
    """The inputs of an experiment; only the quick turn depends on the rig."""
    if experiment is Experiment.QUICK_TURN:
        return _quick_turn(depth_mm, rig)
    turn = _AT_REST[experiment]
    held = turn.turn_s + turn.held_s
    time = [0.0, turn.turn_s] + [held] * (turn.held_s > 0)
    if turn.retracts:
        stops = held + _RETRACT_S
        time += [held + _JUMP_S, stops, stops + _JUMP_S, stops + _REST_S]
    at = np.array(time)
    retracting = (at > held) & (at <= held + _RETRACT_S)
    return Schedule(
        time_s=at,
        drive=TURN_DEG * np.clip(at / turn.turn_s, 0.0, 1.0),
        free_mm=_SLOW_FREE_MM + np.interp(at, [held, held + _RETRACT_S], [0.0, _RETRACT_MM]),
        inserted_mm=np.full(at.size, depth_mm),
        speed_mm_s=np.where(retracting, -_RETRACT_MM / _RETRACT_S, 0.0),
    )


def _quick_turn(depth_mm: float, rig: PaperRig) -> Schedule:
    step = STEP_S[Experiment.QUICK_TURN]
    time = np.linspace(0.0, watched_s(depth_mm), round(watched_s(depth_mm) / step) + 1)
    # Without a free length none grows either: that reading is the model's, not the set-up's.
    grown = -_SPEED_MM_S * time if rig.free_mm > 0 else np.zeros(time.size)
    return Schedule(
        time_s=time,
        drive=rig.motion.angle_deg(time),
        free_mm=rig.free_mm + grown,
        inserted_mm=np.full(time.size, depth_mm),
        speed_mm_s=np.full(time.size, _SPEED_MM_S),
    )


def watched_s(depth_mm: float) -> float:
    """How long a quick turn is watched, s."""
    return max(_WATCHED_S, _WATCHED_S_PER_MM * depth_mm)


def read_off(experiment: Experiment, run: Run, rig: PaperRig) -> Readings:
    """What the paper would have read from a run."""
    tip, torque = rig.model.sensed(run.time_s, run.tip_deg, run.base_torque_n_mm)
    if experiment is Experiment.QUICK_TURN:
        error = TURN_DEG - tip
        return {
            Measure.SETTLING: settling_s(run.time_s, error),
            Measure.INTEGRAL: integral_deg_s(run.time_s, error, INTEGRAL_S),
        }
    turn, lag = _AT_REST[experiment], run.inputs.drive - tip
    half, turned, held = (
        int(np.searchsorted(run.time_s, t - _TIE_S))
        for t in (turn.turn_s / 2, turn.turn_s, turn.turn_s + turn.held_s)
    )
    rate_rad_s = np.radians(TURN_DEG / turn.turn_s)
    readings = {
        Measure.DAMPING: float(torque[half : turned + 1].mean() / rate_rad_s),
        Measure.LAG: float(lag[turned]),
    }
    if turn.held_s:
        readings[Measure.HELD_TORQUE] = float(torque[turned : held + 1].mean())
    if turn.retracts:
        readings[Measure.LAG_LEFT] = float(lag[-1] / lag[held]) if lag[held] else 0.0
    return readings


def settling_s(time_s: Array, error_deg: Array) -> float:
    """Time after which the error stays within 3 deg, s; between samples, smooth in the error.

    An error that is still outside at the end counts as later the larger it is, so that
    a fit can walk back from there; such a time is beyond the last of `time_s`.
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

"""The paper's experiments as inputs of the MuJoCo needle."""

from dataclasses import dataclass

import numpy as np

from sim.schedule import Schedule
from studies.published import criteria
from studies.published.experiments.base_turn import TURN_DEG
from studies.published.experiments.measurement import TurnExperiment
from studies.published.experiments.rig import PublishedRig

_SLOW_FREE_MM = 230.0
_SPEED_MM_S = -2.5  # of the quick turn
_OBSERVED_S, _OBSERVED_S_PER_MM = 2.5, 0.03  # of a quick turn: at least, and by depth
_RETRACT_MM, _RETRACT_S, _REST_S = 5.0, 1.0, 4.0
_JUMP_S = 1e-6


@dataclass(frozen=True, kw_only=True)
class TurnAtRest:
    """90 deg at a constant rate without axial motion; then a hold, and optionally a retraction."""

    turn_s: float = 20.0
    held_s: float = 0.0
    retracts: bool = False


AT_REST = {
    TurnExperiment.SLOW_TURN: TurnAtRest(),
    TurnExperiment.BRISK_TURN: TurnAtRest(turn_s=2.0),
    TurnExperiment.HELD_TURN: TurnAtRest(held_s=10.0),
    TurnExperiment.RELEASE: TurnAtRest(held_s=10.0, retracts=True),
}
_STEP_S = {
    TurnExperiment.QUICK_TURN: criteria.QUICK_STEP_S,
    TurnExperiment.BRISK_TURN: criteria.BRISK_STEP_S,
}


def step_s(experiment: TurnExperiment) -> float:
    """Time step of an experiment's simulation, s."""
    return _STEP_S.get(experiment, criteria.SLOW_STEP_S)


def schedule(experiment: TurnExperiment, depth_mm: float, rig: PublishedRig) -> Schedule:
    """The inputs of an experiment; only the quick turn depends on the rig."""
    if experiment is TurnExperiment.QUICK_TURN:
        return _quick_turn(depth_mm, rig)
    turn = AT_REST[experiment]
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


def _quick_turn(depth_mm: float, rig: PublishedRig) -> Schedule:
    duration = observed_s(depth_mm)
    time = np.linspace(0.0, duration, round(duration / step_s(TurnExperiment.QUICK_TURN)) + 1)
    # A rig without free length is the paper's model, in which none grows either.
    grown = -_SPEED_MM_S * time if rig.free_mm > 0 else np.zeros(time.size)
    return Schedule(
        time_s=time,
        drive=rig.turn.angle_deg(time),
        free_mm=rig.free_mm + grown,
        inserted_mm=np.full(time.size, depth_mm),
        speed_mm_s=np.full(time.size, _SPEED_MM_S),
    )


def observed_s(depth_mm: float) -> float:
    """How long a quick turn is observed, s."""
    return max(_OBSERVED_S, _OBSERVED_S_PER_MM * depth_mm)

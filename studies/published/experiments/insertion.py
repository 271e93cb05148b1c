"""The steered insertion of Figs. 11 and 12: 7 cm at 5 mm/s, half a turn after each of the first 4 cm.

The half turns go to and fro, +180, -180, +180, -180 deg: the paper says that "alternating the
rotation direction would reduce the height deviation", so its tip passed through the same side each
time. (With turns in one sense, the sides alternate.) Deviation is the
largest height of the tip over the plane in which it would curve without turning; the path follows
from the roll of MuJoCo's tip, with the measured radius of curvature of 61 mm.

The paper does not state the length between chuck and tip (assumed: 120 mm), how the base turns
(180 deg in 0.6 s, the rate of the quick turn), the compensator's gain and motor (this project's), or
the tissue (that of Table II).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from diagnosis.replay.rig_parameters import RigParameters
from models.bevel import path_mm
from sim.closed_loop import FeedbackController, Measurement, run_closed_loop
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate
from studies.control.tables import DESIGN
from studies.control.tip_controllers import tip_controller_named
from studies.published.criteria import INSERTION_ELEMENTS, INSERTION_STEP_S
from studies.published.experiments.base_turn import TURN_DEG, BaseTurn, BaseTurnShape
from studies.published.experiments.channel import run_in_channel
from studies.published.experiments.rig import STATED

Array = NDArray[np.float64]

_SPEED_MM_S, _LENGTH_MM, _EVERY_MM, _TURNS = 5.0, 70.0, 10.0, 4
_HALF_TURN_DEG = 180.0
_JUMP_S = 1e-6


class WindingSense(StrEnum):
    """The senses of the half turns."""

    TO_AND_FRO = "to and fro"
    ONE_WAY = "one way"

    @property
    def angles_deg(self) -> Array:
        """Reference before the first half turn and after each, deg, (5,)."""
        turns = np.arange(_TURNS + 1)
        count = turns % 2 if self is WindingSense.TO_AND_FRO else turns
        return np.asarray(_HALF_TURN_DEG * count, np.float64)


@dataclass(frozen=True, kw_only=True)
class InsertionRig:
    """One possible form of the rig of Figs. 11 and 12.

    Attributes:
      model: needle, tissue and drive, as in the diagnosis of rig logs.
      shaft_mm: length between chuck and tip.
      turn: turn of the base by 90 deg without compensation; half turns have the same rate, or servo.
      channel_n_mm: torque of the prebent tip for a quarter turn out of the channel that it cuts.
    """

    model: RigParameters = RigParameters()  # noqa: RUF009 - frozen
    shaft_mm: float = 120.0
    turn: BaseTurn = BaseTurn()  # noqa: RUF009 - frozen
    channel_n_mm: float = 0.0

    def setup(self, inputs: Schedule) -> Setup:
        """The MuJoCo needle of the insertion."""
        return self.model.setup(STATED, inputs, elements=INSERTION_ELEMENTS, step_s=INSERTION_STEP_S)


def reference(shaft_mm: float, sense: WindingSense) -> Schedule:
    """The insertion, with the tip's reference as its drive."""
    at = np.arange(1, _TURNS + 1) * _EVERY_MM / _SPEED_MM_S
    angles = sense.angles_deg
    time = np.concatenate([[0.0], np.repeat(at, 2), [_LENGTH_MM / _SPEED_MM_S]])
    time[2:-1:2] += _JUMP_S
    drive = np.repeat(angles, 2)
    depth = _SPEED_MM_S * time
    return Schedule(
        time_s=time,
        drive=drive,
        free_mm=shaft_mm - depth,
        inserted_mm=depth,
        speed_mm_s=np.full(time.size, _SPEED_MM_S),
    )


def base_alone(rig: InsertionRig, sense: WindingSense = WindingSense.TO_AND_FRO) -> Schedule:
    """The insertion whose base turns as the rig's base does, without compensation."""
    asked = reference(rig.shaft_mm, sense).at_steps(INSERTION_STEP_S)
    drive = np.zeros(asked.time_s.size)
    half_turn = _half_turn(rig.turn)
    for i, by_deg in enumerate(np.diff(sense.angles_deg)):
        since = np.maximum(asked.time_s - (i + 1) * _EVERY_MM / _SPEED_MM_S, 0.0)
        drive += by_deg / TURN_DEG * half_turn.angle_deg(since)
    return Schedule(
        time_s=asked.time_s,
        drive=drive,
        free_mm=asked.free_mm,
        inserted_mm=asked.inserted_mm,
        speed_mm_s=asked.speed_mm_s,
    )


def _half_turn(turn: BaseTurn) -> BaseTurn:
    """The turn by 180 deg: a ramp takes twice as long, a servo the same time."""
    if turn.shape is BaseTurnShape.SERVO:
        return turn
    return BaseTurn(shape=turn.shape, time_s=turn.time_s * _HALF_TURN_DEG / TURN_DEG)


def deviation_mm(run: Run) -> float:
    """Largest height of the tip over the plane of the first curve, mm."""
    path = path_mm(run.inputs.inserted_mm, np.radians(run.tip_deg))
    return float(np.abs(path[:, 2]).max())


def deviations_alone_mm(
    rigs: Sequence[InsertionRig], sense: WindingSense = WindingSense.TO_AND_FRO
) -> list[float]:
    """Deviation of every rig with the base alone, mm; rigs with the same motion are simulated together.

    Raises:
      SimulationFailed: a rig cannot be simulated.
    """
    held = [rig for rig in dict.fromkeys(rigs) if rig.channel_n_mm > 0]
    found = {rig: deviation_mm(_alone_in_channel(rig, sense)) for rig in held}
    free = [rig for rig in dict.fromkeys(rigs) if rig.channel_n_mm == 0]
    for motion in dict.fromkeys((rig.shaft_mm, rig.turn) for rig in free):
        group = [rig for rig in free if (rig.shaft_mm, rig.turn) == motion]
        inputs = base_alone(group[0], sense)
        runs = simulate([rig.setup(inputs) for rig in group], inputs)
        found |= {rig: deviation_mm(run) for rig, run in zip(group, runs, strict=True)}
    return [found[rig] for rig in rigs]


def _alone_in_channel(rig: InsertionRig, sense: WindingSense) -> Run:
    inputs = base_alone(rig, sense)

    def run(tip_torque_n_mm: Array) -> Run:
        loaded = replace(inputs, tip_torque_n_mm=tip_torque_n_mm)
        return simulate([rig.setup(loaded)], loaded)[0]

    return run_in_channel(run, inputs.time_s.size, rig.channel_n_mm)


def deviation_compensated_mm(rig: InsertionRig, sense: WindingSense = WindingSense.TO_AND_FRO) -> float:
    """Deviation with our feedforward compensation, which knows the stated needle only, mm."""
    inputs = reference(rig.shaft_mm, sense).at_steps(INSERTION_STEP_S)

    def run(tip_torque_n_mm: Array) -> Run:
        loaded = replace(inputs, tip_torque_n_mm=tip_torque_n_mm)
        return run_closed_loop(rig.setup(loaded), loaded, _compensator(rig)).run

    return deviation_mm(run_in_channel(run, inputs.time_s.size, rig.channel_n_mm))


def _compensator(rig: InsertionRig) -> FeedbackController:
    controller: FeedbackController = tip_controller_named("feedforward", DESIGN)
    if rig.turn.shape is BaseTurnShape.SERVO:
        return ServoedController(controller, rig.turn.time_s)
    return controller


class ServoedController:
    """A controller whose commands go through a critically damped servo of time constant T.

    Over a step h with a held command, e = base - command with rate v becomes
    e(h) = (e + (v + e / T) h) exp(-h / T).
    """

    def __init__(self, inner: FeedbackController, time_s: float) -> None:
        self.inner, self._time_s = inner, time_s
        self._base_deg, self._rate_deg_s = 0.0, 0.0

    @property
    def advance_mm(self) -> float:
        """Axial motion of the inner controller, mm."""
        return self.inner.advance_mm

    def __call__(self, measurement: Measurement, reference_deg: float) -> float:
        """Angle of the base at the end of the next step, deg."""
        command = self.inner(measurement, reference_deg)
        h, time = INSERTION_STEP_S, self._time_s
        error = self._base_deg - command
        growth = self._rate_deg_s + error / time
        decay = math.exp(-h / time)
        self._base_deg = command + (error + growth * h) * decay
        self._rate_deg_s = (growth - (error + growth * h) / time) * decay
        return self._base_deg

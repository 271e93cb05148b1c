"""What the readings of a sensor follow beside an explanation: a law that a drift would hide.

Beside a drift this is generalised least squares, since a drift is a part of the noise.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from numpy.typing import NDArray

from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay
from diagnosis.replay.sensing.variable_values import of_needle
from diagnosis.replay.variables import Variable

Array = NDArray[np.float64]
Course = Callable[[PreparedTrial, Prediction], Sequence[Array]]

_OF_BOTH: dict[str, Course] = {"axial speed": lambda trial, _: [trial.speed_mm_s]}
_OF_TORQUE: dict[str, Course] = {
    "angle of the base": lambda trial, _: [trial.base_motion_deg - trial.base_motion_deg[0]],
    "turn of the base": lambda trial, _: _circle(trial.base_motion_deg),
}
_OF_TIP: dict[str, Course] = {
    "depth": lambda trial, _: [trial.inserted_mm - trial.inserted_mm[0]],
    "rate of the tip": lambda trial, one: [_of_tip(Variable.TIP_RATE, trial, one)],
    "direction of the tip": lambda trial, one: [_of_tip(Variable.TIP_DIRECTION, trial, one)],
    "angle of the tip": lambda _, one: _circle(one[TIP]),
    "angle of the tip over time": lambda trial, one: [one[TIP], _share(trial.time_s) * one[TIP]],
}
COURSES: Mapping[str, Mapping[str, Course]] = MappingProxyType(
    {TORQUE: _OF_BOTH | _OF_TORQUE, TIP: _OF_BOTH | _OF_TIP}
)
"""Courses of a trial by which a reading may be off, each by a size of its own: by sensor, in words."""


@dataclass(frozen=True, kw_only=True)
class Followed:
    """A law of readings beside an explanation.

    Attributes:
      name: of what they follow.
      gain: that the law takes off the cost.
      parameters: of the law.
    """

    name: str
    gain: float
    parameters: int


def followed(problem: FitProblem, fit: Fit, sensor: str) -> list[Followed]:
    """What the readings of a sensor follow beside a fit of the problem."""
    predictions = replay(problem.log, fit.parameterization.rig(fit.x), problem.resolution)
    each = list(zip(problem.log.trials, predictions, strict=True))
    found = []
    for name, course in COURSES[sensor].items():
        shapes = [np.column_stack(course(trial, one)) for trial, one in each]
        rows = np.concatenate(list(_rows(problem, fit, sensor, shapes)))
        gain = taken_off(fit, rows)
        found.append(Followed(name=name, gain=gain, parameters=rows.shape[1]))
    return found


def taken_off(fit: Fit, courses: Array) -> float:
    """What courses take off the cost of a fit, each by its own size, and the fit as it answers to them.

    Args:
      courses: in sigma, in the rows of the fit's residuals, (N, k).
    """
    basis, _ = np.linalg.qr(fit.slopes)
    rows = np.pad(courses, ((0, fit.residual.size - len(courses)), (0, 0)))  # those of the prior are 0
    beyond, own = (part - basis @ (basis.T @ part) for part in (fit.residual, rows))
    sizes, *_ = np.linalg.lstsq(own, beyond, rcond=None)
    return float(beyond @ own @ sizes)


def _rows(problem: FitProblem, fit: Fit, sensor: str, shapes: Sequence[Array]) -> Iterator[Array]:
    """Courses in the rows of the residuals, in sigma; 0 in those of other sensors."""
    each = zip(problem.log.trials, by_trial_and_sensor(problem, fit.by_trial), shapes, strict=True)
    for trial, parts, own in each:
        for read, time_s, _ in parts:
            kept = own[np.isfinite(trial.readings[read])] / problem.noise[read]
            yield problem.noise.whitened(read, time_s, kept if read == sensor else 0.0 * kept)


def _circle(angle_deg: Array) -> list[Array]:
    """Shapes of what comes once in a turn."""
    return [shape(np.deg2rad(angle_deg)) for shape in (np.sin, np.cos)]


def _of_tip(variable: Variable, trial: PreparedTrial, one: Prediction) -> Array:
    return of_needle(variable, trial.time_s, one[TIP], one[TORQUE])


def _share(time_s: Array) -> Array:
    """Of the trial's duration that is over."""
    return np.asarray((time_s - time_s[0]) / (time_s[-1] - time_s[0]))

"""What an explanation says of the sensors themselves: what they do beside reading, and noise."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.effects import IMPERFECTIONS
from diagnosis.fitting.problem import FitProblem
from diagnosis.replay.drift import drift_ranges_sigma
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.reading_errors import ClockStart, ReadingJump


@dataclass(frozen=True, kw_only=True)
class SensorErrors:
    """Errors of sensors that an explanation allows for.

    Attributes:
      imperfections: their parameters with intervals, by imperfection.
      clock_starts: how long clocks of sensors ran before trials.
      reading_jumps: readings that are off from a moment on.
      drift_sigma: largest range of the drift within a trial, in sigma, by sensor.
    """

    imperfections: dict[str, dict[str, Interval]]
    clock_starts: tuple[ClockStart, ...]
    reading_jumps: tuple[ReadingJump, ...]
    drift_sigma: dict[str, float]


def sensor_errors(
    problem: FitProblem,
    rig: RigParameters,
    predictions: Sequence[Prediction],
    fitted: Mapping[str, dict[str, Interval]],
) -> SensorErrors:
    """The errors of sensors in an explanation.

    Args:
      predictions: readings of that rig, by trial of the problem.
      fitted: parameters of all that is fitted, by name.
    """
    return SensorErrors(
        imperfections={name: own for name, own in fitted.items() if name in IMPERFECTIONS},
        clock_starts=rig.clock_starts,
        reading_jumps=rig.jumps,
        drift_sigma=drift_ranges_sigma(problem.log, problem.noise, predictions),
    )

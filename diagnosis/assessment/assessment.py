"""What is reported in addition to a verdict, as a record."""

from dataclasses import dataclass

from diagnosis.assessment.detection_limits import DetectionLimit
from diagnosis.assessment.gap_reduction import GapReduction
from diagnosis.assessment.nearest import Nearest
from diagnosis.assessment.sensor_errors import SensorErrors
from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.assessment.uncertainty.joint_uncertainty import JointUncertainty
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.twist import ShaftTwist
from diagnosis.residuals.residual_breakdown import ResidualBreakdown
from diagnosis.residuals.residual_shape import ResidualShape


@dataclass(frozen=True, kw_only=True)
class Assessment:
    """What is reported in addition to the verdict.

    Attributes:
      gap: before and after, on held-out trials.
      fitted_gap: of the best explanation of the verdict, on the trials of its fit, in units of `gap`.
      nearest: the best explanation that was tried, whatever the verdict.
      breakdown: breakdown of the residual of the nominal rig.
      breakdown_after: breakdown of the residual of the nearest explanation.
      shape, shape_after: shape of the same two residuals.
      parameters: intervals of parameters, by accepted effect.
      joint: joint uncertainty of the parameters of the nearest explanation.
      sensors: errors of sensors that the nearest explanation allows for.
      with_one_more: what the fitted gap may become with one more effect, by effect.
      detection_limits: largest strength that may go unseen, by effect; empty if the log is not
        explained, or explained by two effects.
      next_experiment: in words; empty if nothing is left to tell apart.
      numerical_error: numerical error of the replay, in sigma, by sensor; empty if there was no time.
      explained: readings that the nearest explanation predicts, at the samples of the log, by trial.
      twist: twist along the shaft at the time of the largest nominal residual, by the nominal rig, with
        each effect alone and with all; None if there was no time.
    """

    gap: GapReduction
    fitted_gap: float
    nearest: Nearest
    breakdown: ResidualBreakdown
    breakdown_after: ResidualBreakdown
    shape: ResidualShape
    shape_after: ResidualShape
    parameters: dict[str, dict[str, Interval]]
    joint: JointUncertainty
    sensors: SensorErrors
    with_one_more: dict[str, float]
    detection_limits: dict[str, DetectionLimit]
    next_experiment: str
    numerical_error: dict[str, float]
    explained: list[Prediction]
    twist: ShaftTwist | None
    warnings: tuple[str, ...]

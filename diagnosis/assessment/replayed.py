"""The nearest explanation replayed: what it predicts, and what it and the nominal rig leave."""

from collections.abc import Sequence
from dataclasses import dataclass

from diagnosis.fitting.problem import FitProblem
from diagnosis.log.rig_log import RigLog
from diagnosis.nominal_replay import at_samples
from diagnosis.replay.drift import with_drift
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.residuals.trial_residual import TrialResidual, trial_residuals
from diagnosis.selection.candidate import Candidate


@dataclass(frozen=True, kw_only=True, eq=False)
class Replayed:
    """What the nearest explanation predicts, and what it and the nominal rig leave.

    Attributes:
      predictions: by trial of the problem.
      explained: at the samples of the log, with drift of the sensors.
      before, left: residuals of the nominal rig, and of the explanation.
    """

    rig: RigParameters
    predictions: list[Prediction]
    explained: list[Prediction]
    before: Sequence[TrialResidual]
    left: Sequence[TrialResidual]

    @classmethod
    def of(
        cls, log: RigLog, problem: FitProblem, nominal: Sequence[Prediction], near: Candidate
    ) -> "Replayed":
        """Of an explanation; the nominal rig was replayed before."""
        rig = near.fit.parameterization.rig(near.fit.x)
        predictions = replay(problem.log, rig, problem.resolution)
        explained = at_samples(problem, with_drift(problem.log, problem.noise, predictions))
        return cls(
            rig=rig,
            predictions=predictions,
            explained=explained,
            before=trial_residuals(log, at_samples(problem, nominal), problem.noise),
            left=trial_residuals(log, explained, problem.noise),
        )

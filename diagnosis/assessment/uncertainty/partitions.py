"""Parts of a log: its trials, or what the base does when a reading is taken."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.residuals import TURNING_DEG_S
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import Read, by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.residuals.motion import base_rate

MOTIONS = ("turning forwards", "turning backwards", "at rest")


@dataclass(frozen=True, kw_only=True, eq=False)
class Partition:
    """Parts of a log.

    Attributes:
      names: of the parts.
      of_rows: number of the part that each row of the residuals of a trial belongs to, (N,) by trial.
    """

    names: tuple[str, ...]
    of_rows: tuple[NDArray[np.int_], ...]

    @property
    def known(self) -> "Partition":
        """The same without parts that have no rows."""
        there = np.unique(np.concatenate(self.of_rows))
        names = tuple(self.names[k] for k in there)
        return Partition(names=names, of_rows=tuple(np.searchsorted(there, own) for own in self.of_rows))


def trial_by_trial(problem: FitProblem, fit: Fit) -> Partition:
    """Each trial is a part."""
    names = tuple(trial.name for trial in problem.log.trials)
    rows = tuple(np.full(own.size, k) for k, own in enumerate(fit.by_trial))
    return Partition(names=names, of_rows=rows).known


def by_motion(problem: FitProblem, fit: Fit) -> Partition:
    """What the base does when a reading is taken is a part."""
    each = zip(problem.log.trials, by_trial_and_sensor(problem, fit.by_trial), strict=True)
    rows = tuple(_motions_when_read(trial, read) for trial, read in each)
    return Partition(names=MOTIONS, of_rows=rows).known


def _motions_when_read(trial: PreparedTrial, read: Sequence[Read]) -> NDArray[np.int_]:
    """Number of the motion of the base at each row of the residuals of a trial, (N,)."""
    motion = _motion(trial)
    own = [motion[np.searchsorted(trial.time_s, time_s)] for _, time_s, _ in read]
    return np.concatenate(own) if own else np.zeros(0, int)


def _motion(trial: PreparedTrial) -> NDArray[np.int_]:
    """Number of the motion of the base at each sample, (N,)."""
    rate = base_rate(trial.time_s, trial.base_motion_deg)
    return np.select([rate > TURNING_DEG_S, rate < -TURNING_DEG_S], [0, 1], 2)

"""Parts of a log: its trials, or what the base does when a reading is taken."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import TURNING_DEG_S
from diagnosis.fitting.fit import Fit
from diagnosis.fitting.noise_reestimation import by_trial_and_sensor
from diagnosis.fitting.problem import FitProblem
from diagnosis.prepare.prepared_log import PreparedTrial
from diagnosis.residuals.motion import base_rate

Array = NDArray[np.float64]

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
    rows = (
        [np.interp(time_s, trial.time_s, _motion(trial)).round() for _, time_s, _ in read]
        for trial, read in each
    )
    joined = (np.concatenate(own).astype(int) if own else np.zeros(0, int) for own in rows)
    return Partition(names=MOTIONS, of_rows=tuple(joined)).known


def _motion(trial: PreparedTrial) -> Array:
    """Number of the motion of the base at each sample, (N,)."""
    rate = base_rate(trial.time_s, trial.base_motion_deg)
    return np.where(rate > TURNING_DEG_S, 0.0, np.where(rate < -TURNING_DEG_S, 1.0, 2.0))

"""A roughness: a change of some stages of a measurement, and the numbers that were drawn for it.

A log is made in stages: its plan, its motions, the ideal signals of a trial, the times of its
samples, their noise, and the columns of all trials. A roughness changes one or two stages.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from validation.logs.motions import LogPlan
from validation.logs.sensors import LogSensors
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.effect import IdealSignals

Array = NDArray[np.float64]
Columns = dict[str, Array]
Noise = dict[str, Array]


@dataclass(frozen=True, kw_only=True)
class Roughness:
    """One roughness with its drawn numbers; every stage is the identity by default.

    Attributes:
      numbers: drawn numbers, for the ground truth.
      plan: changes the plan of the log.
      motions: changes the motions of all trials; they may have a part before the recording.
      signals: changes the signals of a trial on its fine grid; may make them shorter than the motion.
      instants: changes the times at which a trial is sampled, s.
      noise: noise of a trial, by signal, from the times, s, and white noise in the signal's unit.
      columns: changes the columns of all trials.
    """

    name: str
    numbers: Mapping[str, Any]
    plan: Callable[[LogPlan], LogPlan] = lambda plan: plan
    motions: Callable[[Generator, list[TrialMotion]], list[TrialMotion]] = lambda _, motions: motions
    signals: Callable[[TrialMotion, IdealSignals], IdealSignals] = lambda _, signals: signals
    instants: Callable[[Generator, Array], Array] = lambda _, times: times
    noise: Callable[[Array, Noise], Noise] = lambda _, noise: noise
    columns: Callable[[Generator, LogSensors, list[Columns]], list[Columns]] = lambda *given: given[2]

"""What a roughness is: a change of some stages of a measurement, and the numbers that were drawn.

A log is made in stages: its plan, its motions, the ideal signals of a trial, the instants of its
samples, their noise, and the columns of all trials. A roughness changes one or two of them and leaves
the others as they are.
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
      numbers: what was drawn, for the ground truth.
      plan: of the log.
      motions: of all trials; they may have a part before the recording.
      signals: of a trial, on its fine grid; may be shorter than the motion.
      instants: when a trial is sampled, s.
      noise: of a trial, by signal; given the instants, s, and white noise in the unit of the signal.
      columns: of all trials.
    """

    name: str
    numbers: Mapping[str, Any]
    plan: Callable[[LogPlan], LogPlan] = lambda plan: plan
    motions: Callable[[Generator, list[TrialMotion]], list[TrialMotion]] = lambda _, motions: motions
    signals: Callable[[TrialMotion, IdealSignals], IdealSignals] = lambda _, signals: signals
    instants: Callable[[Generator, Array], Array] = lambda _, times: times
    noise: Callable[[Array, Noise], Noise] = lambda _, noise: noise
    columns: Callable[[Generator, LogSensors, list[Columns]], list[Columns]] = lambda *given: given[2]

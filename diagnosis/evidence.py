"""What a fit rests on: a log, its noise, what is left open, and how finely it is replayed."""

from dataclasses import dataclass

import numpy as np

from diagnosis.effects.effect import Effect
from diagnosis.noise import Noise
from diagnosis.rig_log import RigLog, Trial


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Elements of the needle, and the longest step, s."""

    elements: int
    step_s: float

    def step_of(self, trial: Trial) -> float:
        """That of the trial's samples, or the longest if those are rarer."""
        return min(self.step_s, float(np.median(np.diff(trial["time_s"]))))


FINE = Resolution(elements=12, step_s=0.01)
COARSE = Resolution(elements=6, step_s=0.04)


@dataclass(frozen=True, kw_only=True)
class Evidence:
    """A log that can be fitted.

    Attributes:
      nuisance: what every fit leaves open.
    """

    log: RigLog
    noise: Noise
    nuisance: tuple[Effect, ...]
    resolution: Resolution = FINE

"""What a fit rests on: a prepared log, its noise, what is left open, how finely it is replayed."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import FITTED
from diagnosis.effects.effect import Effect
from diagnosis.fitting.parameterization import Parameterization, parameterization_of
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.prepare.sensor_noise import Noise
from diagnosis.replay.replay import predict, residuals
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FitProblem:
    """A log that effects can be fitted to.

    Attributes:
      nuisance: what every fit leaves open.
      library: effects with bounds and starts for a rig of this size.
    """

    log: PreparedLog
    noise: Noise
    nuisance: tuple[Effect, ...]
    resolution: Resolution = FINE
    library: Mapping[str, Effect] = field(default_factory=lambda: FITTED)

    def parameterization(self, names: Sequence[str]) -> Parameterization:
        """Of a set of effects, with what every fit leaves open."""
        return parameterization_of(names, self.nuisance, self.library)

    def residuals(self, rigs: Sequence[RigParameters]) -> list[list[Array]]:
        """Measured minus predicted / sigma: trial by trial, then rig by rig, (M,) each.

        Raises:
          SimulationFailed: a rig cannot be simulated.
        """
        found = []
        for trial in self.log.trials:
            predictions = predict(self.log.rig, trial, rigs, self.resolution)
            found.append([residuals(trial, p, self.noise) for p in predictions])
        return found

    def drifting(self, size_n_mm: float) -> "FitProblem":
        """The same with a torque sensor that may drift by so much within a trial."""
        return replace(self, log=self.log.drifting(size_n_mm / self.noise["base_torque_n_mm"]))

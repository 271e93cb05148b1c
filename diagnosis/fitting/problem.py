"""What a fit rests on: a prepared log, its noise, what is left open, how finely it is replayed."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects import FITTED
from diagnosis.effects.effect import Effect
from diagnosis.fitting.parameterization import Parameterization, parameterization_of
from diagnosis.prepare.motion.base_smoothing import smooth_base
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.replay import predict, residuals
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.workers import side_by_side

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FitProblem:
    """A log that effects can be fitted to.

    Attributes:
      nuisance: what every fit leaves open.
      library: effects with bounds and starts for a rig of this size.
      tolerance_sigma: within which fits converge, in standard deviations of their parameters.
    """

    log: PreparedLog
    noise: Noise
    nuisance: tuple[Effect, ...]
    resolution: Resolution = FINE
    library: Mapping[str, Effect] = field(default_factory=lambda: FITTED)
    tolerance_sigma: float = 0.02

    @property
    def samples(self) -> int:
        """Readings of all sensors."""
        trials = self.log.trials
        return sum(int(np.isfinite(own).sum()) for trial in trials for own in trial.readings.values())

    def parameterization(self, names: Sequence[str]) -> Parameterization:
        """Of a set of effects, with what every fit leaves open."""
        return parameterization_of(names, self.nuisance, self.library)

    def residuals(
        self, rigs: Sequence[RigParameters], *, callback_alone: bool = False
    ) -> list[list[Array]]:
        """Measured minus predicted / sigma: trial by trial, then rig by rig, (M,) each.

        Args:
          callback_alone: for fits on their way, and differences (sim.needles.callback_loop).

        Raises:
          SimulationFailed: a rig cannot be simulated.
        """

        def of(trial: PreparedTrial) -> list[Array]:
            predictions = predict(
                self.log.rig, trial, rigs, self.resolution, callback_alone=callback_alone
            )
            return [residuals(trial, p, self.noise) for p in predictions]

        return side_by_side(of, self.log.trials)

    def read_again(self, rng: np.random.Generator) -> "FitProblem":
        """The problem, the motion of its base read by its encoder and smoothed once more."""
        sigma_deg = self.noise["base_angle_deg"]

        def motion_deg(trial: PreparedTrial) -> Array:
            read = trial.base_motion_deg + rng.normal(0.0, sigma_deg, trial.time_s.size)
            return smooth_base(trial.time_s, read, sigma_deg)

        return self._moving(motion_deg)

    def sharpened(self) -> "FitProblem":
        """The problem with a motion of its base whose corners smoothing rounds to the one it has.

        What smoothing takes off once more is added (twicing; Tukey, 1977): to first order its bias.
        """
        sigma_deg = self.noise["base_angle_deg"]

        def motion_deg(trial: PreparedTrial) -> Array:
            smooth = trial.base_motion_deg
            return 2 * smooth - smooth_base(trial.time_s, smooth, sigma_deg)

        return self._moving(motion_deg)

    def _moving(self, motion_deg: Callable[[PreparedTrial], Array]) -> "FitProblem":
        trials = tuple(replace(trial, base_motion_deg=motion_deg(trial)) for trial in self.log.trials)
        return replace(self, log=replace(self.log, trials=trials))

    def drifting(self, size_n_mm: float) -> "FitProblem":
        """The same with a torque sensor that may drift by so much within a trial."""
        return replace(self, log=self.log.drifting(size_n_mm / self.noise["base_torque_n_mm"]))

"""The fit problem: a prepared log, its noise, the nuisance parameters, the resolution of the replay."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.cores import side_by_side
from diagnosis.effects import FITTED
from diagnosis.effects.effect import Effect
from diagnosis.fitting.parameterization import Parameterization, parameterization_of
from diagnosis.prepare.motion.base_smoothing import smooth_base
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.replay import predict, residuals_of_each
from diagnosis.replay.resolution import FINE, Resolution
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class FitProblem:
    """A log to which effects can be fitted.

    Attributes:
      nuisance: effects that every fit includes.
      library: effects with bounds and starts for a rig of this size.
      tolerance_sigma: tolerance of fits, in standard deviations of their parameters.
      callback_alone: whether fits end without MuJoCo's steps, too: those that only tell which to do
        again (sim.needles.callback_loop).
      differences_halved: whether differences between runs are of runs half as fine, a quarter of the
        cost: most of the error of both cancels.
    """

    log: PreparedLog
    noise: Noise
    nuisance: tuple[Effect, ...]
    resolution: Resolution = FINE
    library: Mapping[str, Effect] = field(default_factory=lambda: FITTED)
    tolerance_sigma: float = 0.02
    callback_alone: bool = False
    differences_halved: bool = False

    @property
    def samples(self) -> int:
        """Number of readings of all sensors."""
        trials = self.log.trials
        return sum(int(np.isfinite(own).sum()) for trial in trials for own in trial.readings.values())

    @property
    def base(self) -> RigParameters:
        """The rig that effects change: the nominal one, but for what the log says of its laws."""
        return replace(NOMINAL, presliding_deg=self.log.presliding_deg)

    @property
    def of_differences(self) -> "FitProblem":
        """The problem of differences between runs; itself if they are as fine as it is."""
        return replace(self, resolution=self.resolution.halved) if self.differences_halved else self

    def parameterization(self, names: Sequence[str]) -> Parameterization:
        """The parameterization of a set of effects, with the nuisance parameters."""
        return parameterization_of(names, self.nuisance, self.library, self.base)

    def residuals(
        self, rigs: Sequence[RigParameters], *, callback_alone: bool = False
    ) -> list[list[Array]]:
        """Measured minus predicted / sigma: trial by trial, then rig by rig, (M,) each.

        Args:
          callback_alone: for iterations of fits and finite differences (sim.needles.callback_loop).

        Raises:
          SimulationFailed: a rig cannot be simulated.
        """

        def of(trial: PreparedTrial) -> list[Array]:
            predictions = predict(
                self.log.rig, trial, rigs, self.resolution, callback_alone=callback_alone
            )
            return residuals_of_each(trial, predictions, self.noise)

        return side_by_side(of, self.log.trials)

    def read_again(self, rng: np.random.Generator) -> "FitProblem":
        """The problem with a motion of the base that was read by its encoder and smoothed once more."""
        sigma_deg = self.noise["base_angle_deg"]
        step_deg = float(np.sqrt(12.0)) * self.log.rounded.get("base_angle_deg", 0.0)

        def motion_deg(trial: PreparedTrial) -> Array:
            if step_deg:
                read = _rounded(trial.base_motion_deg, step_deg, rng.uniform())
            else:
                read = trial.base_motion_deg + rng.normal(0.0, sigma_deg, trial.time_s.size)
            return smooth_base(trial.time_s, read, sigma_deg)

        return self._moving(motion_deg)

    def sharpened(self) -> "FitProblem":
        """The problem with a motion of the base whose corners are restored.

        The change by a second smoothing, to first order the bias, is added (twicing; Tukey, 1977).
        """
        sigma_deg = self.noise["base_angle_deg"]

        def motion_deg(trial: PreparedTrial) -> Array:
            smooth = trial.base_motion_deg
            return 2 * smooth - smooth_base(trial.time_s, smooth, sigma_deg)

        return self._moving(motion_deg)

    def _moving(self, motion_deg: Callable[[PreparedTrial], Array]) -> "FitProblem":
        trials = tuple(replace(trial, base_motion_deg=motion_deg(trial)) for trial in self.log.trials)
        return replace(self, log=replace(self.log, trials=trials))


def _rounded(values: Array, step: float, phase: float) -> Array:
    """Values in steps, of which one is at `phase` steps."""
    return step * (np.round(values / step - phase) + phase)

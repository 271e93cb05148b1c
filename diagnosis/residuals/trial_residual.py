"""Residuals of a trial: measured minus predicted / sigma, sample by sample."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.residuals import LONGEST_LAG_S
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import SENSORS, Trial
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.prediction import Prediction

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True, eq=False)
class TrialResidual:
    """Residuals of one trial.

    Attributes:
      left: residual / sigma by sensor that the trial has, (N,); NaN where nothing was read.
    """

    trial: Trial
    left: Mapping[str, Array]

    @property
    def squares(self) -> Array:
        """Mean square over its sensors at every sample, (N,); NaN where nothing was read."""
        if not self.left:
            return np.full(self.trial["time_s"].shape, np.nan)
        every = np.stack(list(self.left.values())) ** 2
        read = np.isfinite(every)
        total = np.where(read, every, 0.0).sum(axis=0)
        return np.where(read.any(axis=0), total / np.maximum(read.sum(axis=0), 1), np.nan)


def trial_residuals(
    log: RigLog, predictions: Sequence[Prediction], noise: Noise
) -> tuple[TrialResidual, ...]:
    """Residuals of every trial; predictions are at the samples of the log."""
    return tuple(
        TrialResidual(
            trial=trial,
            left={s: (trial[s] - prediction[s]) / noise[s] for s in SENSORS if trial.has(s)},
        )
        for trial, prediction in zip(log.trials, predictions, strict=True)
    )


def by_sensor(residuals: Sequence[TrialResidual]) -> dict[str, list[TrialResidual]]:
    """Trials that have a sensor, by sensor that any trial has."""
    having = {s: [r for r in residuals if s in r.left] for s in SENSORS}
    return {sensor: own for sensor, own in having.items() if own}


def sample_s(residuals: Sequence[TrialResidual]) -> float:
    """Median time between samples, of all trials."""
    steps = [np.diff(residual.trial["time_s"]) for residual in residuals]
    return float(np.median(np.concatenate(steps)))


def on_even_steps(residual: TrialResidual, sensor: str, step_s: float) -> Array:
    """A residual at even steps, (M,): each sample at the nearest; NaN where none was read.

    Pauses are shortened to the longest lag in use, so that nothing is compared across them.
    """
    steps = np.minimum(np.diff(residual.trial["time_s"], prepend=np.nan), LONGEST_LAG_S)
    place = np.rint(np.nancumsum(steps) / step_s).astype(int)
    read = np.isfinite(residual.left[sensor])
    even = np.full(place[-1] + 1, np.nan)
    even[place[read]] = residual.left[sensor][read]
    return even

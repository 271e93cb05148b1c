"""What the sensors of a rig with given effects would have read, in units of noise.

One batch of MuJoCo needles a trial: all candidates side by side.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.noise import Noise
from diagnosis.rig_log import SENSORS, RigLog, Trial
from diagnosis.rig_model import RigModel
from sim.simulation import Run, simulate

Array = NDArray[np.float64]

ELEMENTS = 12
LARGEST_STEP_S = 0.01


def step_s(trial: Trial) -> float:
    """Step of a trial's simulation: that of its samples, or 10 ms if those are rarer."""
    return min(LARGEST_STEP_S, float(np.median(np.diff(trial["time_s"]))))


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """Of one candidate on one trial: by sensor, at the samples, (N,)."""

    tip_angle_deg: Array
    base_torque_n_mm: Array

    def __getitem__(self, sensor: str) -> Array:
        found: Array = getattr(self, sensor)
        return found


def predict(
    log: RigLog, trial: Trial, candidates: Sequence[RigModel], *, threads: int = 1
) -> list[Prediction]:
    """Predictions of one trial by several candidates of one layout."""
    setups = [c.setup(log.rig, trial, elements=ELEMENTS, step_s=step_s(trial)) for c in candidates]
    runs = simulate(setups, trial.schedule(), threads=threads)
    return [_sensed(c, run, trial["time_s"]) for c, run in zip(candidates, runs, strict=True)]


def _sensed(candidate: RigModel, run: Run, at_s: Array) -> Prediction:
    tip, torque = candidate.sensed(run.time_s, run.tip_deg, run.base_torque_n_mm)
    return Prediction(
        tip_angle_deg=np.interp(at_s, run.time_s, tip),
        base_torque_n_mm=np.interp(at_s, run.time_s, torque),
    )


def residuals(trial: Trial, prediction: Prediction, noise: Noise) -> Array:
    """Measured less predicted over noise, all sensors of the trial one after another."""
    parts = []
    for sensor in SENSORS:
        if trial.has(sensor):
            missed = (trial[sensor] - prediction[sensor]) / noise[sensor]
            parts.append(missed[np.isfinite(missed)])
    return np.concatenate(parts) if parts else np.zeros(0)

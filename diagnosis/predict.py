"""What the sensors of a rig with given effects would have read, in units of noise.

One batch of MuJoCo needles a trial: all candidates side by side. Candidates that
differ in their sensors alone share a needle.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from diagnosis.evidence import FINE, Evidence, Resolution
from diagnosis.noise import Noise
from diagnosis.rig_log import SENSORS, Rig, Trial
from diagnosis.rig_model import RigModel
from sim.simulation import Run, simulate

Array = NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Prediction:
    """Of one candidate on one trial: by sensor, at the samples, (N,)."""

    tip_angle_deg: Array
    base_torque_n_mm: Array

    def __getitem__(self, sensor: str) -> Array:
        found: Array = getattr(self, sensor)
        return found

    def rows(self, kept: NDArray[np.bool_]) -> "Prediction":
        """The prediction at some of its samples."""
        return Prediction(**{sensor: self[sensor][kept] for sensor in SENSORS})


def predict(
    rig: Rig, trial: Trial, candidates: Sequence[RigModel], resolution: Resolution = FINE
) -> list[Prediction]:
    """Predictions of one trial by several candidates of one layout.

    Raises:
      SimulationFailed: a candidate cannot be simulated.
    """
    schedule, step = trial.schedule(), resolution.step_of(trial)
    needles = list(dict.fromkeys(c.without_sensors() for c in candidates))
    setups = [n.setup(rig, schedule, elements=resolution.elements, step_s=step) for n in needles]
    runs = dict(zip(needles, simulate(setups, schedule), strict=True))
    return [_sensed(c, runs[c.without_sensors()], trial["time_s"]) for c in candidates]


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


def predicted_residuals(evidence: Evidence, candidates: Sequence[RigModel]) -> list[list[Array]]:
    """Residuals of every candidate: trial by trial, then candidate by candidate."""
    found = []
    for trial in evidence.log.trials:
        predictions = predict(evidence.log.rig, trial, candidates, evidence.resolution)
        found.append([residuals(trial, p, evidence.noise) for p in predictions])
    return found

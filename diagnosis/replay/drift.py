"""The drift of the torque sensor that a prediction leaves, where drift was allowed for."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.prepare.drift import fitted_drift
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.prepare.sensor_noise import Noise
from diagnosis.replay.replay import Prediction

Array = NDArray[np.float64]

TORQUE = "base_torque_n_mm"


def torque_drift(trial: PreparedTrial, prediction: Prediction) -> Array:
    """Drift at every sample, N mm, (N,); 0 where none is allowed for."""
    if not trial.torque_drifts or not trial.has(TORQUE):
        return np.zeros(trial.time_s.size)
    return fitted_drift(trial.time_s, trial.readings[TORQUE] - prediction[TORQUE])


def with_drift(log: PreparedLog, predictions: Sequence[Prediction]) -> list[Prediction]:
    """Predictions of what the sensors read, drift included, by trial."""
    return [
        replace(one, base_torque_n_mm=one.base_torque_n_mm + torque_drift(trial, one))
        for trial, one in zip(log.trials, predictions, strict=True)
    ]


def drift_range_sigma(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> float:
    """Largest range of the drift within a trial, in sigma of the torque."""
    drifts = [torque_drift(t, one) for t, one in zip(log.trials, predictions, strict=True)]
    return max((float(np.ptp(drift)) for drift in drifts), default=0.0) / noise[TORQUE]

"""The likeliest drift of the torque sensor in the residual of a prediction, if drift is allowed for."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria import DRIFT_ALIKE
from diagnosis.prepare.noise.sensor_noise import TORQUE, Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.replay import Prediction

Array = NDArray[np.float64]


def torque_drift_sigma(trial: PreparedTrial, prediction: Prediction, noise: Noise) -> Array:
    """Drift at every sample, in sigma of the torque, (N,); 0 if none is allowed for."""
    drift = noise.drift(TORQUE)
    if drift is None or not trial.has(TORQUE):
        return np.zeros(trial.time_s.size)
    return drift.likeliest(trial.time_s, (trial.readings[TORQUE] - prediction[TORQUE]) / noise[TORQUE])


def with_drift(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> list[Prediction]:
    """Predictions of the readings, including drift, by trial."""
    drifts = _by_trial(log, noise, predictions)
    return [
        replace(one, base_torque_n_mm=one.base_torque_n_mm + noise[TORQUE] * drift)
        for one, drift in zip(predictions, drifts, strict=True)
    ]


def drift_range_sigma(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> float:
    """Largest range of the drift within a trial, in sigma of the torque."""
    return max((float(np.ptp(drift)) for drift in _by_trial(log, noise, predictions)), default=0.0)


def drifts_alike(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> bool:
    """Whether the sensor drifts along a line in every trial, at one rate: a law, and no accident."""
    rates = []
    for trial, drift in zip(log.trials, _by_trial(log, noise, predictions), strict=True):
        if trial.has(TORQUE):
            after_s = trial.time_s - trial.time_s[0]
            line = np.polyfit(after_s, drift, 1)
            if np.ptp(drift - np.polyval(line, after_s)) > DRIFT_ALIKE * np.ptp(drift):
                return False
            rates.append(float(line[0]))
    return len(rates) > 1 and float(np.ptp(rates)) <= DRIFT_ALIKE * abs(float(np.mean(rates)))


def least_start(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> float:
    """By how much the drift begins off zero in every trial at least, in standard deviations."""
    drift = noise.drift(TORQUE)
    each = zip(log.trials, predictions, strict=True)
    read = [(t, (t.readings[TORQUE] - p[TORQUE]) / noise[TORQUE]) for t, p in each if t.has(TORQUE)]
    if drift is None or not read:
        return 0.0
    return min(abs(drift.start(trial.time_s, left)) for trial, left in read)


def follows_speed(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> float:
    """How much of the axial speed is in the residual of the torque, in standard deviations.

    By generalised least squares: the drift is a part of the noise.
    """
    shared, power = 0.0, 0.0
    for trial, one in zip(log.trials, predictions, strict=True):
        if not trial.has(TORQUE):
            continue
        left = (trial.readings[TORQUE] - one[TORQUE]) / noise[TORQUE]
        read = np.isfinite(left)
        time_s, speed = trial.time_s[read], trial.speed_mm_s[read]
        white, own = (noise.whitened(TORQUE, time_s, part) for part in (left[read], speed))
        shared, power = shared + float(white @ own), power + float(own @ own)
    return shared / float(np.sqrt(power)) if power > 0 else 0.0


def _by_trial(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> list[Array]:
    each = zip(log.trials, predictions, strict=True)
    return [torque_drift_sigma(trial, one, noise) for trial, one in each]

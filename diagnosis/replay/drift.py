"""The likeliest drift of a sensor in the residual of a prediction, if drift is allowed for."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.selection import DRIFT_ALIKE
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.prepare.prepared_log import PreparedLog, PreparedTrial
from diagnosis.replay.prediction import Prediction

Array = NDArray[np.float64]


def drift_sigma(trial: PreparedTrial, sensor: str, prediction: Prediction, noise: Noise) -> Array:
    """Drift at every sample, in sigma of the sensor, (N,); 0 if none is allowed for."""
    drift = noise.drift(sensor)
    if drift is None or not trial.has(sensor):
        return np.zeros(trial.time_s.size)
    return drift.likeliest(trial.time_s, _left(trial, sensor, prediction, noise))


def with_drift(log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]) -> list[Prediction]:
    """Predictions of the readings, including drift, by trial."""
    each = zip(log.trials, predictions, strict=True)
    return [
        replace(one, **{s: one[s] + noise[s] * drift_sigma(trial, s, one, noise) for s in noise.drifts})
        for trial, one in each
    ]


def drift_ranges_sigma(
    log: PreparedLog, noise: Noise, predictions: Sequence[Prediction]
) -> dict[str, float]:
    """Largest range of the drift within a trial, by sensor and in its sigma."""
    return {s: drift_range_sigma(log, s, noise, predictions) for s in SENSORS}


def drift_range_sigma(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> float:
    """Largest range of the drift within a trial, in sigma of the sensor."""
    drifts = _by_trial(log, sensor, noise, predictions)
    return max((float(np.ptp(drift)) for drift in drifts), default=0.0)


def drift_in_a_second_sigma(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> float:
    """Largest change of the drift within a second, in sigma of the sensor."""
    drifts = _by_trial(log, sensor, noise, predictions)
    return max(
        (_change_in_a_second(trial.time_s, own) for trial, own in zip(log.trials, drifts, strict=True)),
        default=0.0,
    )


def _change_in_a_second(time_s: Array, drift: Array) -> float:
    later = np.interp(time_s + 1.0, time_s, drift)
    return float(np.abs(later - drift).max())


def drift_spread_sigma(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> float:
    """Range of the drift over all trials, in sigma of the sensor: another zero in each counts too."""
    drifts = _by_trial(log, sensor, noise, predictions)
    return float(np.ptp(np.concatenate([np.zeros(0), *drifts]))) if drifts else 0.0


def drift_means_apart(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> float:
    """Range of the means of the drift over each trial, in sigma of the sensor."""
    means = means_sigma(log, sensor, noise, predictions)
    return float(np.ptp(means)) if means.size else 0.0


def drift_ranges_sum(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> float:
    """Ranges of the drift within all trials together, in sigma of the sensor."""
    return sum(float(np.ptp(drift)) for drift in _by_trial(log, sensor, noise, predictions))


def drifts_along_lines(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> bool:
    """Whether the sensor drifts along a line in every trial."""
    return len(_rates(log, sensor, noise, predictions)) == sum(trial.has(sensor) for trial in log.trials)


def drifts_alike(log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]) -> bool:
    """Whether the sensor drifts along a line in every trial, at one rate: a law, and no accident."""
    rates = _rates(log, sensor, noise, predictions)
    along_lines = drifts_along_lines(log, sensor, noise, predictions)
    return (
        along_lines
        and len(rates) > 1
        and float(np.ptp(rates)) <= DRIFT_ALIKE * abs(float(np.mean(rates)))
    )


def _rates(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> list[float]:
    """Rates of the drift in the trials where it is a line, sigma / s."""
    rates = []
    for trial, drift in zip(log.trials, _by_trial(log, sensor, noise, predictions), strict=True):
        after_s = trial.time_s - trial.time_s[0]
        line = np.polyfit(after_s, drift, 1)
        off = drift - np.polyval(line, after_s)
        if trial.has(sensor) and np.ptp(off) <= DRIFT_ALIKE * np.ptp(drift):
            rates.append(float(line[0]))
    return rates


def drifts_by_one_course(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> bool:
    """Whether the sensor drifts along one course in every trial, wherever it begins: a law."""
    drifts = _by_trial(log, sensor, noise, predictions)
    each = [
        (trial.time_s - trial.time_s[0], drift)
        for trial, drift in zip(log.trials, drifts, strict=True)
        if trial.has(sensor)
    ]
    if len(each) < 2:
        return False
    shortest_s = min((after_s for after_s, _ in each), key=lambda after_s: float(after_s[-1]))
    courses = np.array([np.interp(shortest_s, after_s, drift) for after_s, drift in each])
    courses -= courses.mean(axis=1, keepdims=True)
    apart = float(np.ptp(courses, axis=0).max())
    return apart <= DRIFT_ALIKE * float(np.ptp(courses.mean(axis=0)))


def starts(log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]) -> Array:
    """Where the drift begins in every trial that was read, in standard deviations, (T,)."""
    drift = noise.drift(sensor)
    each = zip(log.trials, predictions, strict=True)
    read = [(trial, _left(trial, sensor, one, noise)) for trial, one in each if trial.has(sensor)]
    return np.array([drift.start(trial.time_s, left) for trial, left in read if drift])


def means_sigma(log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]) -> Array:
    """Mean of the drift over every trial that was read, in sigma of the sensor, (T,)."""
    each = zip(log.trials, _by_trial(log, sensor, noise, predictions), strict=True)
    return np.array([drift.mean() for trial, drift in each if trial.has(sensor)])


def _by_trial(
    log: PreparedLog, sensor: str, noise: Noise, predictions: Sequence[Prediction]
) -> list[Array]:
    each = zip(log.trials, predictions, strict=True)
    return [drift_sigma(trial, sensor, one, noise) for trial, one in each]


def _left(trial: PreparedTrial, sensor: str, one: Prediction, noise: Noise) -> Array:
    """What a prediction leaves, in sigma, (N,)."""
    return np.asarray((trial.readings[sensor] - one[sensor]) / noise[sensor])

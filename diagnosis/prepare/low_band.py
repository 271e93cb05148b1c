"""Smoothed readings in the low band, where the filter that was used after recording has changed little.

What such a filter H left above its corner is unknown, well below it nearly everything. Readings and
predictions both pass a lower filter F, symmetric about each row, so that

    F (H y + noise) - F (y predicted) = noise in the band of F

hardly depends on H. F is the root of a raised cosine, whose powers at frequencies that thinning folds
together add up to 1: rows one over twice its corner apart have white noise, and they alone count. Of
a symmetric filter H with its corner at f0 there remain

    H(f) = 1 - a (f / f0)^2 - b (f / f0)^4

which are fitted: a = 0, b = 1 for a Butterworth filter of second order that was run twice, for example.
"""

from dataclasses import replace
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import convolve1d
from scipy.signal import firwin2

from diagnosis.criteria import BAND_LOBES, BAND_ROLL_OFF, BAND_SHARE
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]

_POINTS, _GRID = 65, 8193  # of a response in its band; frequencies from which a kernel is computed


def in_low_band(log: RigLog) -> RigLog:
    """The log with smoothed readings in their low band, at independent rows; NaN between them."""
    for sensor, corner_hz in log.smoothed_above_hz.items():
        trials = tuple(_in_low_band(trial, sensor, corner_hz) for trial in log.trials)
        step_s = float(np.median([_step_s(trial["time_s"]) for trial in trials]))
        left = {sensor: float(np.linalg.norm(_kernel(corner_hz, step_s)))}
        quieter = log.rig.model_copy(update={"sensors": log.rig.sensors.scaled(left)})
        log = replace(log, trials=trials, rig=quieter, noise_left={**log.noise_left, **left})
    return log


def low_passed(
    time_s: Array, values: Array, corner_hz: float, second: float = 0.0, fourth: float = 0.0
) -> Array:
    """Values in the low band of readings that were smoothed, (N,).

    Args:
      corner_hz: corner of the filter by which they were smoothed.
      second, fourth: its coefficients a and b, for values that were not.
    """
    step_s = _step_s(time_s)
    kernel = _kernel(corner_hz, step_s)
    for power, coefficient in ((2, second), (4, fourth)):
        if coefficient:
            kernel = kernel - coefficient * _kernel(corner_hz, step_s, power)
    return np.asarray(convolve1d(values, kernel, mode="nearest"))


def _step_s(time_s: Array) -> float:
    return float(np.median(np.diff(time_s)))


@lru_cache(maxsize=64)  # every prediction asks for the same
def _kernel(corner_hz: float, step_s: float, power: int = 0) -> Array:
    """Symmetric kernel of the low band times (f / corner)^power, of an odd size.

    Where rows are too rare for the band, all of it is in them: a single 1, or 0 of a higher power.
    """
    middle_hz = BAND_SHARE * corner_hz
    first_hz, last_hz = ((1 + side * BAND_ROLL_OFF) * middle_hz for side in (-1, 1))
    if last_hz >= 0.5 / step_s:
        return np.full(1, 0.0 if power else 1.0)
    hz = np.linspace(0.0, last_hz, _POINTS)
    falls = np.clip((hz - first_hz) / (last_hz - first_hz), 0.0, 1.0)
    gains = np.cos(0.5 * np.pi * falls) * (hz / corner_hz) ** power
    half = int(np.ceil(BAND_LOBES / (2 * middle_hz * step_s)))
    edges, own = np.append(hz, 0.5 / step_s), np.append(gains, 0.0)
    return np.asarray(firwin2(2 * half + 1, edges, own, nfreqs=_GRID, fs=1 / step_s))


def _in_low_band(trial: Trial, sensor: str, corner_hz: float) -> Trial:
    """The trial with independent rows of a sensor, without those within a period of its ends."""
    if not trial.has(sensor):
        return trial
    time_s, values = trial["time_s"], trial[sensor]
    read, step_s = np.isfinite(values), _step_s(time_s)
    slow = low_passed(time_s, np.interp(time_s, time_s[read], values[read]), corner_hz)
    end = int(np.ceil(1.0 / (corner_hz * step_s)))
    rows = np.zeros(time_s.size, bool)
    rows[end : time_s.size - end : max(1, round(0.5 / (BAND_SHARE * corner_hz * step_s)))] = True
    return replace(trial, table=trial.table.assign(**{sensor: np.where(rows & read, slow, np.nan)}))

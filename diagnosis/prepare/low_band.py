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

from diagnosis.criteria.faults import BAND_LOBES, BAND_ROLL_OFF, BAND_SHARE
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]

_POINTS, _GRID = 65, 8193  # of a response in its band; frequencies from which a kernel is computed
_HOLE = 4.5  # steps: over fewer, a smoothed reading is a line


def in_low_band(log: RigLog) -> RigLog:
    """The log with smoothed readings in their low band, at independent rows; NaN between them."""
    for sensor, corner_hz in log.smoothed_above_hz.items():
        trials = tuple(_in_low_band(trial, sensor, corner_hz) for trial in log.trials)
        step_s = float(np.median([_step_s(trial["time_s"]) for trial in trials]))
        left = {sensor: float(np.linalg.norm(_kernel(corner_hz, step_s)))}
        quieter = log.rig.model_copy(update={"sensors": log.rig.sensors.scaled(left)})
        log = replace(
            log,
            trials=trials,
            rig=quieter,
            noise_left={**log.noise_left, **left},
            as_read=log.stated_rig,
        )
    return log


def low_passed(
    time_s: Array, values: Array, corner_hz: float, second: float = 0.0, fourth: float = 0.0
) -> Array:
    """Values in the low band of readings that were smoothed, (N,); where times are uneven, on even ones.

    Args:
      corner_hz: corner of the filter by which they were smoothed.
      second, fourth: its coefficients a and b, for values that were not.
    """
    step_s = _step_s(time_s)
    kernel = _kernel(corner_hz, step_s)
    if kernel.size == 1:
        return values
    for power, coefficient in ((2, second), (4, fourth)):
        if coefficient:
            kernel = kernel - coefficient * _kernel(corner_hz, step_s, power)
    even_s = time_s[0] + step_s * np.arange(round((time_s[-1] - time_s[0]) / step_s) + 1)
    slow = convolve1d(np.interp(even_s, time_s, values), kernel, mode="nearest")
    return np.asarray(np.interp(time_s, even_s, slow))


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
    """The trial with independent rows of a sensor, far from its ends and from where none was read."""
    if not trial.has(sensor):
        return trial
    time_s, values = trial["time_s"], trial[sensor]
    read, step_s = np.isfinite(values), _step_s(time_s)
    slow = low_passed(time_s, np.interp(time_s, time_s[read], values[read]), corner_hz)
    apart_s = max(1, round(0.5 / (BAND_SHARE * corner_hz * step_s))) * step_s
    wanted_s = np.arange(time_s[0] + 1.0 / corner_hz, time_s[-1] - 1.0 / corner_hz, apart_s)
    near = np.clip(np.searchsorted(time_s[read], wanted_s), 1, np.count_nonzero(read) - 1)
    before_s, after_s = time_s[read][near - 1], time_s[read][near]
    certain = np.array(
        [not _beside_hole(time_s[read], at_s, apart_s, step_s) for at_s in wanted_s], bool
    )
    rows = np.flatnonzero(read)[np.where(wanted_s - before_s < after_s - wanted_s, near - 1, near)]
    kept = np.isin(np.arange(time_s.size), rows[certain])
    return replace(trial, table=trial.table.assign(**{sensor: np.where(kept, slow, np.nan)}))


def _beside_hole(read_s: Array, at_s: float, reach_s: float, step_s: float) -> bool:
    """Whether readings are missing within reach of a time, more than a line can stand for."""
    first, last = np.searchsorted(read_s, (at_s - reach_s, at_s + reach_s))
    about_s = read_s[max(first - 1, 0) : last + 1]
    return bool(np.diff(about_s).max(initial=0.0) > _HOLE * step_s)

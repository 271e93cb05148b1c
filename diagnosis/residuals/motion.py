"""How the base moves at each sample of a trial: its rate, the phase, the time since it turned back."""

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.fitting import SLIDING_MM_S
from diagnosis.criteria.residuals import AFTER_REVERSAL_S, TURNING_DEG_S
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]
Mask = NDArray[np.bool_]

_SMOOTH_S = 0.2


def base_rate(time_s: Array, base_deg: Array) -> Array:
    """Rate of the base, deg/s, (N,), from angles averaged over 0.2 s."""
    width = max(3, round(_SMOOTH_S / float(np.median(np.diff(time_s)))))
    padded = np.pad(base_deg, width, mode="edge")
    smooth = np.convolve(padded, np.ones(width) / width, "same")
    return np.asarray(np.gradient(smooth[width:-width], time_s))


def phases(trial: Trial) -> dict[str, Mask]:
    """Masks of a trial's samples: they may overlap."""
    turning = np.abs(_rate(trial)) > TURNING_DEG_S
    speed = trial["speed_mm_s"]
    return {
        "turning": turning,
        "holding": ~turning,
        "reversal": since_reversal(trial) < AFTER_REVERSAL_S,
        "translating": np.abs(speed) > SLIDING_MM_S,
        "retracting": speed < -SLIDING_MM_S,
    }


def direction(trial: Trial) -> Array:
    """+1 or -1, the direction in which the base turns or last turned, (N,); 0 before its first turn."""
    rate = _rate(trial)
    turning = np.abs(rate) > TURNING_DEG_S
    last = np.maximum.accumulate(np.where(turning, np.arange(rate.size), -1))
    return np.where(last >= 0, np.sign(rate[last]), 0.0)


def since_reversal(trial: Trial) -> Array:
    """Time since the last reversal of the base, s, (N,); infinite before the first one."""
    time, way = trial["time_s"], direction(trial)
    turned = np.flatnonzero(np.diff(way) * way[:-1]) + 1
    began = np.concatenate([[-np.inf], time[turned]])
    return np.asarray(time - began[np.searchsorted(turned, np.arange(time.size), side="right")])


def _rate(trial: Trial) -> Array:
    return base_rate(trial["time_s"], trial["base_angle_deg"])

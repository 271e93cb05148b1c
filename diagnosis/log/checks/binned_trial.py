"""A trial in equal bins of time, and lagging copies of its signals.

Bins keep checks of a long log fast, and remove most of the noise. The tip of a passive needle
is nearly a lagging copy of its base: this tells which column leads, with which sign,
and by how much time.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.signal import lfilter

from diagnosis.criteria.checks import LARGE_TURN_DEG
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]

_BINS = 1500
_LAGS_S = (0.0, 0.1, 0.3, 1.0, 3.0, 10.0, 30.0)
_DELAYS_S = (0.0, 0.1, 0.2, 0.3, 0.5, 0.7, 1.0)


@dataclass(frozen=True, kw_only=True)
class BinnedTrial:
    """A trial in equal bins of time.

    Attributes:
      base_angle_deg, tip_angle_deg, base_torque_n_mm: means of the bins; empty if not measured.
      bin_s: length of a bin.
    """

    base_angle_deg: Array
    tip_angle_deg: Array
    base_torque_n_mm: Array
    bin_s: float


def binned(trial: Trial) -> BinnedTrial:
    """Means of equal bins; a bin without a reading is interpolated."""
    time = trial["time_s"]
    count = min(_BINS, time.size // 2)
    bin_s = float(time[-1] - time[0]) / count
    index = np.minimum(((time - time[0]) / bin_s).astype(int), count - 1)

    def means(column: str) -> Array:
        if not trial.has(column):
            return np.zeros(0)
        values = trial[column]
        good = np.isfinite(values)
        number = np.bincount(index[good], minlength=count)
        filled = np.flatnonzero(number)
        sums = np.bincount(index[good], values[good], count)[filled]
        return np.interp(np.arange(count), filled, sums / number[filled])

    return BinnedTrial(
        base_angle_deg=means("base_angle_deg"),
        tip_angle_deg=means("tip_angle_deg"),
        base_torque_n_mm=means("base_torque_n_mm"),
        bin_s=bin_s,
    )


def misfit(driving: Array, following: Array, bin_s: float) -> tuple[float, float]:
    """Shares of a signal's variance that lagging copies of another leave unexplained.

    The copies pass a delay and a first-order lag; the better of several is taken,
    once with gains above 0, once with gains below.
    """
    least = {True: 1.0, False: 1.0}
    wanted = following - following.mean()
    for lag_s in _LAGS_S:
        lagged = lagging(driving, lag_s, bin_s)
        for delay_s in _DELAYS_S:
            shift = min(round(delay_s / bin_s), lagged.size)
            copy = np.concatenate((np.zeros(shift), lagged[: lagged.size - shift]))
            copy -= copy.mean()
            product, size = copy @ wanted, (copy @ copy) * (wanted @ wanted)
            if size > 0:
                same = bool(product > 0)
                least[same] = min(least[same], 1 - product**2 / size)
    return float(least[True]), float(least[False])


def lagging(driving: Array, lag_s: float, bin_s: float) -> Array:
    """A signal after a first-order lag, starting at rest, (N,)."""
    gain = 1 - np.exp(-bin_s / lag_s) if lag_s else 1.0
    return np.asarray(lfilter([gain], [1, gain - 1], driving - driving[0]))


def both_turn(turning: BinnedTrial) -> bool:
    """Whether base and tip turn far enough to be judged."""
    base, tip = turning.base_angle_deg, turning.tip_angle_deg
    return tip.size > 0 and bool(min(np.ptp(base), 2 * np.ptp(tip)) >= LARGE_TURN_DEG)


def correlation(one: Array, other: Array) -> float:
    """Correlation of two signals; 0 if one of them does not change."""
    if np.ptp(one) == 0 or np.ptp(other) == 0:
        return 0.0
    return float(np.corrcoef(one, other)[0, 1])

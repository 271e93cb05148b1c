"""Rests and reversals of the base, for an angle in any unit.

The rate is the slope of a straight line through the samples of a short window. If the readings
scatter by s and a window of width w has n of them, the slope scatters by sqrt(12) s / (w sqrt(n)):
motion slower than four of these cannot be distinguished from rest.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.signal import find_peaks, savgol_filter

from diagnosis.criteria.lab_files import (
    REST_LEAST_S,
    REST_RATE_SHARE,
    REST_RATE_SIGMA,
    REVERSAL_SHARE,
)
from diagnosis.lab_files.readers.lab_table import Array
from diagnosis.log.faults.scatter import quantum
from diagnosis.log.white_noise import white_noise

Mask = NDArray[np.bool_]

_MOST_SAMPLES = 200_000


@dataclass(frozen=True, kw_only=True)
class Motion:
    """The motion of the base.

    Attributes:
      time_s: times of the readings, (N,).
      rate_per_s: rate, in units of the angle per second, (N,).
      resting: whether it is at rest, (N,).
      rests_s: first and last time of each rest.
      reversals: index of each turning point, in order.
    """

    time_s: Array
    rate_per_s: Array
    resting: Mask
    rests_s: tuple[tuple[float, float], ...]
    reversals: tuple[int, ...]

    def at_rest(self, time_s: Array) -> Mask:
        """Mask of times that lie in a rest."""
        inside = np.zeros(time_s.size, bool)
        for first, last in self.rests_s:
            inside |= (time_s >= first) & (time_s <= last)
        return inside

    def in_first_rest(self, time_s: Array) -> Mask:
        """Mask of times in the rest at the start of the trial; all False if it starts in motion."""
        if not self.rests_s or self.rests_s[0][0] > self.time_s[0]:
            return np.zeros(time_s.size, bool)
        first, last = self.rests_s[0]
        return np.asarray((time_s >= first) & (time_s <= last))


def motion_of(time_s: Array, angle: Array) -> Motion:
    """Rests and reversals of an angle in any unit, (N,); values that are not finite are left out."""
    good = np.isfinite(time_s) & np.isfinite(angle)
    time_s, angle = time_s[good], angle[good]
    even = np.linspace(time_s[0], time_s[-1], min(time_s.size, _MOST_SAMPLES))
    step_s = max(float(even[1] - even[0]), 1e-12)
    smooth = np.interp(even, time_s, angle)
    window = max(3, round(REST_LEAST_S / step_s) | 1)
    window = min(window, (even.size - 1) | 1) if even.size > 3 - 1 else 1
    rate = savgol_filter(smooth, window, 1, deriv=1, delta=step_s)
    noise, width = white_noise([angle], order=2), window * step_s
    uncertain = np.sqrt(12 / window) / width * (noise if np.isfinite(noise) else 0.0)
    least = max(
        REST_RATE_SIGMA * uncertain, quantum(angle) / width, REST_RATE_SHARE * float(np.abs(rate).max())
    )
    slow = np.abs(rate) <= least
    spans = [(a, b) for a, b in _runs(slow) if even[b - 1] - even[a] >= REST_LEAST_S]
    rests = tuple((float(even[a]), float(even[b - 1])) for a, b in spans)
    own_rate = np.interp(time_s, even, rate)
    motion = Motion(
        time_s=time_s,
        rate_per_s=own_rate,
        resting=np.zeros(time_s.size, bool),
        rests_s=rests,
        reversals=_reversals(angle, noise if np.isfinite(noise) else 0.0),
    )
    return replace(motion, resting=motion.at_rest(time_s))


def _reversals(angle: Array, noise: float) -> tuple[int, ...]:
    """Indices of turning points that exceed a share of the whole turn, and the noise by far."""
    least = max(REVERSAL_SHARE * float(np.ptp(angle)), 4 * REST_RATE_SIGMA * noise, 1e-12)
    high, low = (find_peaks(sign * angle, prominence=least)[0] for sign in (1, -1))
    return tuple(int(i) for i in np.sort(np.concatenate((high, low))))


def _runs(true: Mask) -> list[tuple[int, int]]:
    edges = np.flatnonzero(np.diff(np.concatenate(([0], true.astype(np.int8), [0]))))
    return [(int(a), int(b)) for a, b in edges.reshape(-1, 2)]

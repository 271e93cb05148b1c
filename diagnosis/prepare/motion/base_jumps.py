"""Jumps of the base's reading.

Between two samples the reading moves by more than on either side,

    jump = move - move clipped to what lies between those at the median rates just before and after it,

far beyond its scatter. Between moves that are steady a large one is no turn of the shaft, which gains
speed over several. Across a gap in the time nothing is told.
"""

from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray
from scipy.ndimage import percentile_filter

from diagnosis.criteria.faults import (
    LOST_COUNTS_BESIDE,
    LOST_COUNTS_LEAST_DEG,
    LOST_COUNTS_MOST_SMALL,
    LOST_COUNTS_SIGMA,
    LOST_COUNTS_SMALL_SIGMA,
    LOST_COUNTS_STEADY,
    LOST_COUNTS_STEP,
)
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import BASE

Array = NDArray[np.float64]

_NEAR, _USUAL = 101, 67  # moves of which a jump sticks out; percentile: of noise, a third are no jumps


@dataclass(frozen=True, kw_only=True)
class Jump:
    """A jump of the base's reading.

    Attributes:
      number: of the trial.
      sample: first one after it.
      at_s: its time.
      scatter_deg: of the size as it was read.
    """

    number: int
    sample: int
    at_s: float
    size_deg: float
    scatter_deg: float

    def times(self, share: float) -> "Jump":
        """A jump there of a share of its size."""
        return replace(self, size_deg=share * self.size_deg)


def large_jumps(log: RigLog) -> list[Jump]:
    """Jumps between steady moves, which the nominal rig may tell from turns, largest first."""
    return _jumps(log, LOST_COUNTS_SIGMA, LOST_COUNTS_LEAST_DEG, steady=True)


def small_jumps(log: RigLog) -> list[Jump]:
    """Jumps that only an explanation may tell from noise: the largest of each trial."""
    jumps = _jumps(log, LOST_COUNTS_SMALL_SIGMA, 0.0, steady=False)
    by_trial = ([j for j in jumps if j.number == number] for number in range(len(log.trials)))
    return [jump for own in by_trial for jump in own[:LOST_COUNTS_MOST_SMALL]]


def _jumps(log: RigLog, least_sigma: float, least_deg: float, *, steady: bool) -> list[Jump]:
    """Those of all trials, largest first.

    Args:
      least_sigma, least_deg: least size, in usual jumps and in deg.
      steady: whether only those between steady moves.
    """
    sigma_deg = log.rig.sensors.base_angle_noise_deg
    found = list[Jump]()
    for number, trial in enumerate(log.trials):
        samples, jumps = _jumps_of(trial["time_s"], trial[BASE], steady=steady)
        _, amid_all = _jumps_of(trial["time_s"], trial[BASE], steady=False)
        scatter_deg = np.maximum(_usual(amid_all), sigma_deg)
        least = np.maximum(least_sigma * np.maximum(_usual(jumps), sigma_deg), least_deg)
        for i in np.flatnonzero(np.abs(jumps) > least):
            sample = int(samples[i])
            at_s = float(trial["time_s"][sample])
            found.append(
                Jump(
                    number=number,
                    sample=sample,
                    at_s=at_s,
                    size_deg=float(jumps[i]),
                    scatter_deg=float(scatter_deg[i]),
                )
            )
    return sorted(found, key=lambda jump: -abs(jump.size_deg))


def _usual(jumps: Array) -> Array:
    """Usual size of jumps near each of them."""
    return percentile_filter(np.abs(jumps), _USUAL, size=_NEAR) if jumps.size else jumps


def _jumps_of(time_s: Array, base_deg: Array, *, steady: bool) -> tuple[NDArray[np.intp], Array]:
    """First samples after moves that may be jumps, and by how much these are more than those beside."""
    moves, beside = np.diff(base_deg), LOST_COUNTS_BESIDE
    if moves.size < 4 * beside:
        return np.zeros(0, np.intp), np.zeros(0)
    steps_s = np.diff(time_s)
    medians = np.median(sliding_window_view(moves / steps_s, beside), axis=1)
    here = np.arange(beside, moves.size - beside)
    before, after = (medians[i] * steps_s[here] for i in (here - beside, here + 1))
    jumps = moves[here] - np.clip(moves[here], np.minimum(before, after), np.maximum(before, after))
    even = steps_s[here] < LOST_COUNTS_STEP * np.median(steps_s)
    if steady:
        most = np.maximum(_range_of(moves, here - beside), _range_of(moves, here + 1))
        even &= most < LOST_COUNTS_STEADY * np.abs(jumps)
    return here + 1, np.where(even, jumps, 0.0)


def _range_of(moves: Array, first: NDArray[np.intp]) -> Array:
    """Largest less smallest of a few moves from each of the first ones on, (N,)."""
    return np.asarray(np.ptp(sliding_window_view(moves, LOST_COUNTS_BESIDE)[first], axis=1))

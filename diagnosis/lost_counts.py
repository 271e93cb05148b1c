"""An encoder of the base that loses counts: its reading jumps, and the shaft does not.

Between two samples the reading moves by more than on either side,

    jump = move - move clipped to what lies between the medians of a few moves before and after it,

far beyond its scatter, while moves on either side are steady: a shaft gains speed over several. Across
a gap in the time nothing is told. Whether the shaft has moved so is for the other sensors to say: where
the nominal rig leaves clearly less of them once the readings after the jump are shifted back, counts
were lost. A fast turn of the shaft would leave far more.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from numpy.typing import NDArray

from diagnosis.criteria import (
    LOST_COUNTS_BESIDE,
    LOST_COUNTS_LEAST_DEG,
    LOST_COUNTS_LEAVES,
    LOST_COUNTS_MOST,
    LOST_COUNTS_SIGMA,
    LOST_COUNTS_STEADY,
    LOST_COUNTS_STEP,
)
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import Trial

Array = NDArray[np.float64]

_BASE = "base_angle_deg"
GapOf = Callable[[RigLog], float]


@dataclass(frozen=True, kw_only=True)
class _Jump:
    """A jump of the base's reading.

    Attributes:
      number: of the trial.
      sample: first one after it.
    """

    number: int
    sample: int
    size_deg: float


def with_counts_restored(log: RigLog, gap_of: GapOf) -> RigLog:
    """The log with the readings of the base shifted back by what its encoder lost, and warnings.

    Args:
      gap_of: root mean square of what the nominal rig leaves of a log with one trial, over the noise.
    """
    for jump in _jumps(log):
        trial = log.trials[jump.number]
        restored = _shifted(trial, jump)
        before, after = (gap_of(replace(log, trials=(own,))) for own in (trial, restored))
        if after < LOST_COUNTS_LEAVES * before:
            trials = [restored if own is trial else own for own in log.trials]
            log = replace(log, trials=tuple(trials), warnings=(*log.warnings, _said(trial, jump)))
    return log


def _jumps(log: RigLog) -> list[_Jump]:
    """The largest ones of all trials, largest first."""
    sigma_deg = log.rig.sensors.base_angle_noise_deg
    found = [
        jump
        for number, trial in enumerate(log.trials)
        for jump in _jumps_of(trial["time_s"], trial[_BASE], number, sigma_deg)
    ]
    return sorted(found, key=lambda jump: -abs(jump.size_deg))[:LOST_COUNTS_MOST]


def _jumps_of(time_s: Array, base_deg: Array, number: int, sigma_deg: float) -> Iterator[_Jump]:
    moves, beside = np.diff(base_deg), LOST_COUNTS_BESIDE
    if moves.size < 4 * beside:
        return
    medians = np.median(sliding_window_view(moves, beside), axis=1)
    here = np.arange(beside, moves.size - beside)
    before, after = medians[here - beside], medians[here + 1]
    jumps = moves[here] - np.clip(moves[here], np.minimum(before, after), np.maximum(before, after))
    scatter = max(float(np.median(np.abs(jumps[jumps != 0.0]))) if jumps.any() else 0.0, sigma_deg)
    least = max(LOST_COUNTS_SIGMA * scatter, LOST_COUNTS_LEAST_DEG)
    steady = np.maximum(_range_of(moves, here - beside), _range_of(moves, here + 1))
    steps_s = np.diff(time_s)
    even = steps_s[here] < LOST_COUNTS_STEP * np.median(steps_s)
    sure = even & (np.abs(jumps) > least) & (steady < LOST_COUNTS_STEADY * np.abs(jumps))
    for i in np.flatnonzero(sure):
        yield _Jump(number=number, sample=int(here[i]) + 1, size_deg=float(jumps[i]))


def _range_of(moves: Array, first: NDArray[np.intp]) -> Array:
    """Largest less smallest of a few moves from each of the first ones on, (N,)."""
    return np.asarray(np.ptp(sliding_window_view(moves, LOST_COUNTS_BESIDE)[first], axis=1))


def _shifted(trial: Trial, jump: _Jump) -> Trial:
    base = trial[_BASE].copy()
    base[jump.sample :] -= jump.size_deg
    return replace(trial, table=trial.table.assign(**{_BASE: base}))


def _said(trial: Trial, jump: _Jump) -> str:
    at_s = trial["time_s"][jump.sample]
    return (
        f"{trial.name}: {_BASE} jumps by {jump.size_deg:.3g} deg at {at_s:.3f} s, and the other sensors "
        "say that the shaft did not (lost counts); readings after it are shifted back by as much: check "
        "the encoder and its cable"
    )

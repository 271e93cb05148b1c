"""An encoder of the base that loses counts: its reading jumps, and the shaft does not.

Whether the shaft has moved so is for the other sensors to say: where a rig leaves clearly less of them
once the readings after the jump are shifted back, counts were lost. A fast turn of the shaft would leave
far more.

By how much is then for all sensors to say: the jump as it was read, which scatters by s, and N readings
r of the others, in sigma, whose squares change as a parabola of what is shifted back,

    (size - read)^2 / s^2 + N mean(r^2) / max(m, 1)  ->  least,

m the mean of r^2 at the size as it was read, so that what a missing effect leaves weighs little.

The nominal rig shows large jumps before anything else is known. Those that an effect hides from it, and
small ones, show beside what the search has found (diagnosis.selection.jumps_beside).
"""

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.faults import LOST_COUNTS_FURTHEST, LOST_COUNTS_LEAVES, LOST_COUNTS_MOST
from diagnosis.log.rig_log import RigLog
from diagnosis.log.trial import BASE, Trial
from diagnosis.prepare.motion.base_jumps import Jump, large_jumps

Array = NDArray[np.float64]

LeftOf = Callable[[RigLog], Array]


def with_counts_restored(log: RigLog, left_of: LeftOf) -> RigLog:
    """The log with the readings of the base shifted back by what its encoder lost, and warnings.

    Args:
      left_of: what the nominal rig leaves of a log with one trial, in sigma, NaN where nothing is read.
    """
    left = dict[int, float]()
    for jump in large_jumps(log)[:LOST_COUNTS_MOST]:
        trial = log.trials[jump.number]
        if jump.number not in left:
            left[jump.number] = _squares(left_of(_alone(log, trial)))
        after = _squares(left_of(_alone(log, _shifted(trial, jump))))
        if after < LOST_COUNTS_LEAVES**2 * left[jump.number]:
            log = _restored(log, _sized(log, jump, left_of))
            left[jump.number] = after
    return log


def with_jumps_restored(log: RigLog, jumps: Sequence[Jump]) -> RigLog:
    """The log with the readings after these jumps shifted back, and warnings."""
    for jump in jumps:
        log = _restored(log, jump)
    return log


def _sized(log: RigLog, jump: Jump, left_of: LeftOf) -> Jump:
    """The jump with its likeliest size, from the reading and from what other sizes would leave."""
    trial, step = log.trials[jump.number], jump.scatter_deg / jump.size_deg
    each = [left_of(_alone(log, _shifted(trial, jump.times(1.0 + n * step)))) for n in (-1, 0, 1)]
    less, read, more = (_squares(left) for left in each)
    weight = np.isfinite(each[1]).sum() / max(read, 1.0)
    slope, bend = weight * (more - less) / 2.0, weight * max(more - 2.0 * read + less, 0.0)
    off = float(
        np.clip(-slope / (bend + 2.0), -LOST_COUNTS_FURTHEST, LOST_COUNTS_FURTHEST)
    )  # in the scatter
    return jump.times(1.0 + off * step)


def _squares(left: Array) -> float:
    """Mean square of what is left; 0: nothing is read."""
    return float(np.nanmean(left**2)) if np.isfinite(left).any() else 0.0


def _alone(log: RigLog, trial: Trial) -> RigLog:
    return replace(log, trials=(trial,))


def _restored(log: RigLog, jump: Jump) -> RigLog:
    """The log with a jump shifted back, and a warning."""
    trial = log.trials[jump.number]
    trials = [_shifted(own, jump) if own is trial else own for own in log.trials]
    return replace(log, trials=tuple(trials), warnings=(*log.warnings, _said(trial, jump)))


def _shifted(trial: Trial, jump: Jump) -> Trial:
    base = trial[BASE].copy()
    base[jump.sample :] -= jump.size_deg
    return replace(trial, table=trial.table.assign(**{BASE: base}))


def _said(trial: Trial, jump: Jump) -> str:
    return (
        f"{trial.name}: {BASE} jumps by {jump.size_deg:.3g} deg at {jump.at_s:.3f} s, and the other "
        "sensors say that the shaft did not (lost counts); readings after it are shifted back by as "
        "much: check the encoder and its cable"
    )

"""Tissue that changes in time, of which what less damping changes tells when.

It gives way, or grips, at an unknown time, and stays so in the trials that follow, or to the end of
that trial. It may also change between two trials: where the needle is inserted in another place. Its
torque is multiplied by a factor from then on. The starting value of the time is the one from which on
a multiple of the change takes most off the nominal residual,

    gain(t) = (sum of change * residual after t)^2 / sum of change^2 after t,  in units of the noise.
"""

from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Parameter, Place
from diagnosis.freeform.families.in_time.events import (
    Moment,
    around,
    change_between,
    curves_of,
    event_family,
    times_of,
    trials_after,
)
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import SENSORS, TIP
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]

_EITHER = {Place.TISSUE: 0.6, Place.INTERFACE: 0.4}
_LEAST_S = 1.0  # from either end of a trial
_START, _LEAST, _MOST = (0.6, 1.6), 0.01, 100.0  # factor
_LONGEST_S = 5.0  # that it takes to change


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Both changes, if the log is long enough and less damping was simulated."""
    return tuple(_gives_way(*change) for change in changes_of(ranges)) if ranges.softer else ()


def changes_of(ranges: LogRanges) -> tuple[tuple[Moment, tuple[str, ...]], ...]:
    """The largest change that stays, with the trials that follow it; and that of one trial alone.

    One that stays in the last trial, which none follow, is of that trial alone: the larger one counts.
    """
    (kept, for_good), (gain, once) = (_gain_and_moment(ranges, stays) for stays in (True, False))
    after = trials_after(ranges, for_good) if for_good else ()
    larger = for_good if kept > gain else once
    found = [(for_good, after), (once, ())] if after else [(larger, ())]
    return tuple((moment, trials) for moment, trials in found if moment)


def largest_change(ranges: LogRanges, *, stays: bool = True) -> Moment | None:
    """From when on a changed damping takes most off the nominal residual; None: trials are too short.

    Args:
      stays: whether it is changed in the trials that follow, too.
    """
    return _gain_and_moment(ranges, stays)[1]


def _gain_and_moment(ranges: LogRanges, stays: bool) -> tuple[float, Moment | None]:
    """What the largest change takes off, in cost, and when it is."""
    best, found, along, size = 0.0, None, 0.0, 0.0
    trials = ranges.problem.log.trials
    for number in reversed(range(len(trials))):
        time_s, product, square = in_time(ranges, number)
        after = along + np.cumsum(product[::-1])[::-1]
        squares = size + np.cumsum(square[::-1])[::-1]
        gain = np.where(squares > 0, after**2 / np.maximum(squares, 1e-300), 0.0)
        inside = (time_s > _LEAST_S) & (time_s < time_s[-1] - _LEAST_S) if time_s.size else []
        if time_s.size and number > 0 and stays:
            inside[0] = True  # between two trials
        gain = np.where(inside, gain, 0.0)
        if gain.size and gain.max() > best:
            at = int(np.argmax(gain))
            best, found = float(gain[at]), Moment(trial=trials[number].name, time_s=float(time_s[at]))
        if stays:
            along, size = along + float(product.sum()), size + float(square.sum())
    return best, found


def in_time(ranges: LogRanges, number: int, *, of_damping: bool = True) -> tuple[Array, Array, Array]:
    """Of a trial, in the order of time: s after its start, change * residual, and change^2, (N,) each.

    Args:
      of_damping: whether the change is that of less damping; else it is that of the tip's angle.
    """
    problem = ranges.problem
    trial, each = problem.log.trials[number], [np.zeros((3, 0))]  # where nothing was read
    for sensor in filter(trial.has, SENSORS):
        nominal, noise = ranges.nominal[number][sensor], problem.noise[sensor]
        change = (ranges.softer[number][sensor] - nominal) / noise
        if not of_damping:
            change = np.full(change.size, 1.0 / noise if sensor == TIP else 0.0)
        left = (trial.readings[sensor] - nominal) / noise
        read = np.isfinite(left)
        after_s = trial.time_s[read] - trial.time_s[0]
        each.append(np.stack([after_s, (change * left)[read], (change**2)[read]]))
    rows = np.concatenate(each, axis=1)
    time_s, product, square = rows[:, np.argsort(rows[0], kind="stable")]
    return time_s, product, square


def _gives_way(moment: Moment, after: tuple[str, ...]) -> Family:
    """The change; in trials `after` it, it stays."""
    when, lasting = (replace(p, start=2 * p.start) for p in times_of(moment))
    lasting = replace(lasting, high=_LONGEST_S)
    factor = Parameter(
        name="factor", unit="-", low=_LEAST, high=_MOST, start=_START, logarithmic=True, neutral=1.0
    )
    return event_family(
        moment,
        after,
        what="tissue that gives way",
        in_words="tissue that gives way or grips",
        told="torque of the tissue",
        places=_EITHER,
        parameters=(when, lasting, factor),
        apply=partial(_apply, moment.trial, after),
        curve=_changes,
        unit="-",
    )


def _changes(time_s: float, duration_s: float, factor: float) -> Points:
    return change_between(time_s, duration_s, 1.0, factor)


def _apply(
    trial: str,
    after: tuple[str, ...],
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    factor: float,
) -> RigParameters:
    curves = curves_of(ActsOn.TISSUE, trial, after, around(time_s, duration_s), (1.0, factor))
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=curves))

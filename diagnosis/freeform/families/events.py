"""A single event: an angle or a reading that steps, at an unknown time, fast or slowly.

What has stepped may be back at the start of the next trial, or stay so in all that follow.

The starting value of the time is from the residual of the nominal rig: of all times of all trials, the
one at which the means before and after differ most, in units of their scatter (two-sample test).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.readings import TIP, TORQUE
from diagnosis.freeform.family import Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import ActsOn, Curve, FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from diagnosis.residuals.largest_step import ResidualStep, largest_step

Array = NDArray[np.float64]

_SHORTEST_S, _USUAL_S, _LONGEST_S = 0.01, 0.1, 1.0  # that a step takes
_MOVES_S = 1.5  # at the most, from where it is looked for first
_LEAST_S = 0.5  # from either end of a trial
DIFFERENCES = (0.3, 0.1, 3e-2)
"""Steps of derivatives by time, duration and size."""
_PLACES = {
    ActsOn.DRIVE_ANGLE: (TIP, Place.DRIVE, "slip between drive and needle"),
    ActsOn.TIP_READING: (TIP, Place.SENSOR, "jump of the tip sensor"),
    ActsOn.TORQUE_READING: (TORQUE, Place.SENSOR, "jump of the torque sensor"),
}


@dataclass(frozen=True, kw_only=True)
class Moment:
    """The time of an event: its trial, and s after the start of it."""

    trial: str
    time_s: float


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """One step for each angle or reading, if the log is long enough."""
    found = []
    for acts_on, (sensor, place, title) in _PLACES.items():
        moment = largest_event(ranges, sensor) if sensor in ranges.missing else None
        if moment is not None:
            found.append(_step(acts_on, place, title, moment, ranges.missing[sensor], ()))
            if after := trials_after(ranges, moment):
                found.append(_step(acts_on, place, title, moment, ranges.missing[sensor], after))
    return tuple(found)


def trials_after(ranges: LogRanges, moment: Moment) -> tuple[str, ...]:
    """Names of the trials that follow that of an event."""
    names = [trial.name for trial in ranges.problem.log.trials]
    return tuple(names[names.index(moment.trial) + 1 :])


def times_of(moment: Moment, usual_s: float = _USUAL_S) -> tuple[Parameter, Parameter]:
    """Parameters of an event: when it is, and how long it takes."""
    low, high = max(0.0, moment.time_s - _MOVES_S), moment.time_s + _MOVES_S
    when = Parameter(name="time", unit="s", low=low, high=high, start=(moment.time_s,), scale=1.0)
    lasting = Parameter(
        name="duration",
        unit="s",
        low=_SHORTEST_S,
        high=_LONGEST_S,
        start=(usual_s,),
        logarithmic=True,
        neutral=None,
    )
    return when, lasting


def largest_event(ranges: LogRanges, sensor: str) -> Moment | None:
    """Where the mean of the nominal residual changes most; None: all trials are too short."""
    trials = [t for t in ranges.problem.log.trials if t.has(sensor)]
    best, found = 0.0, None
    for trial, left in zip(trials, ranges.left[sensor], strict=True):
        read = np.isfinite(left)
        time_s = trial.time_s[read] - trial.time_s[0]
        step = _largest_change(time_s, left[read])
        if step is not None and step.gain > best:
            best, found = step.gain, Moment(trial=trial.name, time_s=float(time_s[step.sample]))
    return found


def _largest_change(time_s: Array, left: Array) -> ResidualStep | None:
    """The step of a trial that takes most off, beside a mean."""
    beside = int(np.searchsorted(time_s, _LEAST_S, side="right"))
    return largest_step(left, np.ones((left.size, 1)), [slice(None)], beside)


def _step(
    acts_on: ActsOn, place: Place, title: str, moment: Moment, size: float, after: tuple[str, ...]
) -> Family:
    """The step; in trials `after` it, it stays."""
    how, where = ("for good", f"from {moment.trial} on") if after else ("once", f"in {moment.trial}")
    step = replace(coordinates(1, 0, size)[0], name="step", prior_sigma=math.inf)
    return Family(
        effect=Effect(
            name=f"{title}, {how}",
            title=f"{title}, {how}, {where}",
            place=place,
            parameters=(*times_of(moment), step),
            apply=partial(_apply, acts_on, moment.trial, after),
            differences=DIFFERENCES,
            trial="" if after else moment.trial,
        ),
        places={place: 1.0},
        says="event",
        title=f"{title} {where}",
        curve=_stepped,
        x_unit="s",
        unit="N mm" if acts_on is ActsOn.TORQUE_READING else "deg",
    )


def _stepped(time_s: float, duration_s: float, step: float) -> Points:
    return (0.0, time_s, time_s + duration_s, time_s + 2.0), (0.0, 0.0, step, step)


def _apply(
    acts_on: ActsOn,
    trial: str,
    after: tuple[str, ...],
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    step: float,
) -> RigParameters:
    curves = curves_of(acts_on, trial, after, (time_s, time_s + duration_s), (0.0, step))
    return replace(rig, free=FreeLaw(curves=curves))


def curves_of(
    acts_on: ActsOn,
    trial: str,
    after: Sequence[str],
    times_s: tuple[float, float],
    values: tuple[float, float],
) -> tuple[Curve, ...]:
    """A value that changes in one trial, and keeps to the second one in those after it."""
    of_time = partial(Curve, acts_on=acts_on, variable=Variable.TIME)
    changes = of_time(places=times_s, values=values, trial=trial)
    stays = (of_time(places=(0.0, 1.0), values=2 * values[1:], trial=name) for name in after)
    return (changes, *stays)

"""An event: an angle or a reading that steps, at an unknown time, fast or slowly.

What has stepped may be back at the start of the next trial, or stay so in all that follow.

The starting value of the time is from the residual of the nominal rig: of all times of all trials, the
one at which a step takes most off (residuals/step_time.py).
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, coordinates, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from diagnosis.residuals.step_time import step_of

Array = NDArray[np.float64]

_SHORTEST_S, _USUAL_S, _LONGEST_S = 0.01, 0.3, 1.0  # that a step takes
_MOVES_S = 1.5  # at the most, from where it is looked for first
_SHOWN_AFTER_S = 2.0  # of the curve of an event
DIFFERENCES = (0.3, 0.1, 3e-2)
"""Steps of derivatives by time, duration and size."""
STEPS = {
    ActsOn.DRIVE_ANGLE: (TIP, Place.DRIVE, "slip between drive and needle"),
    ActsOn.TIP_READING: (TIP, Place.SENSOR, "jump of the tip sensor"),
    ActsOn.TORQUE_READING: (TORQUE, Place.SENSOR, "jump of the torque sensor"),
}
"""What may step: the sensor that shows it, where it lies, and what it is."""


@dataclass(frozen=True, kw_only=True)
class Moment:
    """The time of an event: its trial, and s after the start of it; and the way it steps, 1 or -1."""

    trial: str
    time_s: float
    way: int = 1


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Steps of each angle or reading, if the log is long enough."""
    found = []
    for acts_on, (sensor, place, title) in STEPS.items():
        moments = events(ranges, sensor) if sensor in ranges.missing else ()
        if moments:
            largest, size = moments[0], max(ranges.missing[sensor], ranges.problem.noise[sensor])
            found.append(step(acts_on, place, title, largest, size, ()))
            if after := trials_after(ranges, largest):
                found.append(step(acts_on, place, title, largest, size, after))
    return tuple(found)


def trials_after(ranges: LogRanges, moment: Moment) -> tuple[str, ...]:
    """Names of the trials that follow that of an event."""
    names = [trial.name for trial in ranges.problem.log.trials]
    return tuple(names[names.index(moment.trial) + 1 :])


def how_and_where(moment: Moment, after: Sequence[str]) -> tuple[str, str]:
    """That an event is once or for good, and in which trial or from which on, in words."""
    return ("for good", f"from {moment.trial} on") if after else ("once", f"in {moment.trial}")


def times_of(moment: Moment) -> tuple[Parameter, Parameter]:
    """Parameters of an event: when it is, and how long it takes."""
    low, high = max(0.0, moment.time_s - _MOVES_S), moment.time_s + _MOVES_S
    when = Parameter(
        name="time", unit="s", low=low, high=high, start=(moment.time_s,), scale=1.0, neutral=None
    )
    lasting = Parameter(
        name="duration",
        unit="s",
        low=_SHORTEST_S,
        high=_LONGEST_S,
        start=(_USUAL_S,),
        logarithmic=True,
        neutral=None,
    )
    return when, lasting


def events(ranges: LogRanges, sensor: str) -> tuple[Moment, ...]:
    """Where the mean of the nominal residual changes most, by trial; the largest change first.

    Trials that are too short have none.
    """
    trials = [t for t in ranges.problem.log.trials if t.has(sensor)]
    found = []
    for trial, left in zip(trials, ranges.left[sensor], strict=True):
        read = np.isfinite(left)
        time_s = trial.time_s[read] - trial.time_s[0]
        step = step_of(time_s, left[read])
        if step is not None:
            before, after = np.split(left[read], [step.sample])
            way = -1 if before.sum() * after.size > after.sum() * before.size else 1
            when = Moment(trial=trial.name, time_s=float(time_s[step.sample]), way=way)
            found.append((step.gain, when))
    return tuple(moment for _, moment in sorted(found, key=lambda one: -one[0]))


def step(
    acts_on: ActsOn, place: Place, title: str, moment: Moment, size: float, after: tuple[str, ...]
) -> Family:
    """The step; in trials `after` it, it stays."""
    return event_family(
        moment,
        after,
        what=title,
        in_words=title,
        told=title,
        places={place: 1.0},
        parameters=started(times_of(moment), size),
        apply=partial(_apply, acts_on, moment.trial, after),
        curve=stepped,
        unit=unit_of(acts_on),
    )


def event_family(
    moment: Moment,
    after: tuple[str, ...],
    *,
    what: str,
    in_words: str,
    told: str,
    places: Mapping[Place, float],
    parameters: tuple[Parameter, ...],
    apply: Callable[..., RigParameters],
    curve: Callable[..., Points],
    unit: str,
) -> Family:
    """The family of what happens at a moment, and stays in trials `after` it.

    Args:
      what, in_words, told: beginnings of its name, of the title of its effect, and of that of its curve.
    """
    how, where = how_and_where(moment, after)
    return Family(
        effect=Effect(
            name=f"{what}, {how}",
            title=f"{in_words}, {how}, {where}",
            place=most_probable(places),
            parameters=parameters,
            apply=apply,
            differences=DIFFERENCES,
            trial="" if after else moment.trial,
        ),
        places=places,
        says="event",
        title=f"{told} {where}",
        curve=curve,
        x_unit="s",
        unit=unit,
    )


def started(parameters: Sequence[Parameter], size: float) -> tuple[Parameter, ...]:
    """Parameters of an event, and the size of its step, which starts from either sign."""
    step = replace(coordinates(1, 0, size)[0], name="step", prior_sigma=math.inf)
    most = max(len(p.start) for p in parameters)
    each = [replace(p, start=most * p.start) if len(p.start) < most else p for p in parameters]
    own = replace(step, start=most * (size,) + most * (-size,))
    return (*(replace(p, start=2 * p.start) for p in each), own)


def unit_of(acts_on: ActsOn) -> str:
    """Of what steps."""
    return "N mm" if acts_on is ActsOn.TORQUE_READING else "deg"


def stepped(time_s: float, duration_s: float, step: float) -> Points:
    """The curve of a step from 0, from the start of its trial."""
    return change_between(time_s, duration_s, 0.0, step)


def change_between(time_s: float, duration_s: float, before: float, after: float) -> Points:
    """The curve of an event, from the start of its trial."""
    begins, ends = around(time_s, duration_s)
    return (0.0, begins, ends, ends + _SHOWN_AFTER_S), (before, before, after, after)


def around(time_s: float, duration_s: float) -> tuple[float, float]:
    """When an event begins and ends: its time is the middle, which its duration does not move."""
    return max(0.0, time_s - 0.5 * duration_s), time_s + 0.5 * duration_s


def _apply(
    acts_on: ActsOn,
    trial: str,
    after: tuple[str, ...],
    rig: RigParameters,
    time_s: float,
    duration_s: float,
    step: float,
) -> RigParameters:
    curves = curves_of(acts_on, trial, after, around(time_s, duration_s), (0.0, step))
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

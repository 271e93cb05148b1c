"""An event: an angle or a reading that steps, at an unknown time, fast or slowly.

What has stepped may be back at the start of the next trial, or stay so in all that follow. Or it steps
once in every trial, by as much to either side, each time at a time of its own.

The starting value of the time is from the residual of the nominal rig: of all times of all trials, the
one at which a step takes most off (residuals/step_time.py).
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.stats import theilslopes

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import FARTHEST, Family, Points, coordinates, most_probable
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
_SAME = 1e-3  # durations whose range is less, of their mean, are one
DIFFERENCES = (0.3, 0.1, 3e-2)
"""Steps of derivatives by time, duration and size."""
_PLACES = {
    ActsOn.DRIVE_ANGLE: (TIP, Place.DRIVE, "slip between drive and needle"),
    ActsOn.TIP_READING: (TIP, Place.SENSOR, "jump of the tip sensor"),
    ActsOn.TORQUE_READING: (TORQUE, Place.SENSOR, "jump of the torque sensor"),
}


@dataclass(frozen=True, kw_only=True)
class Moment:
    """The time of an event: its trial, and s after the start of it; and the way it steps, 1 or -1."""

    trial: str
    time_s: float
    way: int = 1


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Steps of each angle or reading, if the log is long enough."""
    found = []
    for acts_on, (sensor, place, title) in _PLACES.items():
        moments = events(ranges, sensor) if sensor in ranges.missing else ()
        if moments:
            largest, size = moments[0], max(ranges.missing[sensor], ranges.problem.noise[sensor])
            found.append(step(acts_on, place, title, largest, size, ()))
            if after := trials_after(ranges, largest):
                found.append(step(acts_on, place, title, largest, size, after))
            if len(moments) > 1:
                each = _EveryTrial.at(moments, ranges)
                found.append(_steps(acts_on, place, title, each, largest, size))
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
        curve=_stepped,
        unit=_unit(acts_on),
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


def _unit(acts_on: ActsOn) -> str:
    return "N mm" if acts_on is ActsOn.TORQUE_READING else "deg"


def _stepped(time_s: float, duration_s: float, step: float) -> Points:
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


@dataclass(frozen=True, kw_only=True, eq=False)
class _EveryTrial:
    """An event in every trial: its times are a straight line over the durations, and what is off it.

    Attributes:
      trials: their names, (n,).
      found_s: when it was found in each, (n,).
      ways: 1 where it steps as in the first of these, -1 where it steps the other way, (n,).
      line: times of a line by its parameters, (n, 1 or 2): a time, and more in longer trials.
      off_line: times by the other coordinates, orthogonal to these, (n, n - 1 or 2).
    """

    trials: tuple[str, ...]
    found_s: Array
    ways: Array
    line: Array
    off_line: Array

    @classmethod
    def at(cls, moments: Sequence[Moment], ranges: LogRanges) -> "_EveryTrial":
        """The events, as they were found."""
        log = {trial.name: trial for trial in ranges.problem.log.trials}
        lasting = np.array([np.ptp(log[m.trial].time_s) for m in moments])
        longer = lasting / lasting.mean() - 1.0
        columns = [np.ones(longer.size), *([longer] if np.ptp(longer) > _SAME else [])]
        return cls(
            trials=tuple(m.trial for m in moments),
            found_s=np.array([m.time_s for m in moments]),
            ways=np.array([m.way * moments[0].way for m in moments]),
            line=np.stack(columns, axis=1),
            off_line=null_space(np.stack(columns)),
        )

    @property
    def parameters(self) -> tuple[Parameter, ...]:
        """Coordinates of the times; they start where events were found, and from a line through most."""
        own, *_ = np.linalg.lstsq(self.line, self.found_s, rcond=None)
        line = (
            Parameter(
                name=name, unit="s", low=least, high=most, start=(exact, robust), neutral=None, scale=1.0
            )
            for name, exact, robust in zip(("time", "longer"), own, self._robust_line(), strict=False)
            for least, most in [(min(exact, robust) - FARTHEST, max(exact, robust) + FARTHEST)]
        )
        found = self.off_line.T @ self.found_s
        off = zip(coordinates(0, found.size), found, strict=True)
        return (*line, *(_starting_at(p, float(found)) for p, found in off))

    def _robust_line(self) -> tuple[float, ...]:
        if self.line.shape[1] == 1:
            return (float(np.median(self.found_s)),)
        theil_sen = theilslopes(self.found_s, self.line[:, 1])
        return float(theil_sen.intercept), float(theil_sen.slope)

    def times_s(self, c: Sequence[float]) -> Array:
        """When it is in each trial."""
        own = np.concatenate([self.line, self.off_line], axis=1)
        return np.asarray(np.maximum(own @ np.array(c), 0.0))


def _starting_at(parameter: Parameter, found: float) -> Parameter:
    """A coordinate that starts from what was found, or from none, with its range about both."""
    low, high = parameter.low + min(found, 0.0), parameter.high + max(found, 0.0)
    return replace(parameter, start=(found, 0.0), low=low, high=high, neutral=None)


def _steps(
    acts_on: ActsOn, place: Place, title: str, each: _EveryTrial, usual: Moment, size: float
) -> Family:
    """A step once in every trial."""
    _, lasting = times_of(usual)
    name = f"{title} once in every trial"
    return Family(
        effect=Effect(
            name=name,
            title=name,
            place=place,
            parameters=started((lasting, *each.parameters), size),
            apply=partial(_apply_to_each, acts_on, each),
            differences=DIFFERENCES,
        ),
        places={place: 1.0},
        says="event",
        title=name,
        curve=partial(_stepped_first, each),
        x_unit=f"s of {each.trials[0]}",
        unit=_unit(acts_on),
    )


def _stepped_first(each: _EveryTrial, duration_s: float, *c: float) -> Points:
    *times, step = c
    return _stepped(float(each.times_s(times)[0]), duration_s, step)


def _apply_to_each(
    acts_on: ActsOn, each: _EveryTrial, rig: RigParameters, duration_s: float, *c: float
) -> RigParameters:
    *times, step = c
    steps = (
        curves_of(acts_on, trial, (), around(float(time_s), duration_s), (0.0, float(way) * step))
        for trial, time_s, way in zip(each.trials, each.times_s(times), each.ways, strict=True)
    )
    return replace(rig, free=FreeLaw(curves=tuple(curve for one in steps for curve in one)))


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

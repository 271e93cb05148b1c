"""Several events: an angle or a reading that steps at several times of a log, each step by its own size.

A drive loses steps, a tracker is registered anew, a load cell is zeroed. Times and sizes start from the
residual of the nominal rig, cut where a step takes most off, and each part once more (binary
segmentation); the law is tried where such steps are most of the residual. One event alone, or one in
every trial, are laws of their own (events.py). The others tell nothing of the
steps of a trial that is left out of a fit: they stay as fitted.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.criteria.freeform import STEPS_GAIN, STEPS_MOST, STEPS_SHARE
from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_time.events import DIFFERENCES
from diagnosis.freeform.family import Family, Points, of_trials
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from diagnosis.residuals.step_time import step_of

Array = NDArray[np.float64]

_LASTS_S = 0.02
_APART_S = 1e-6
_MOVES_S = 0.3  # at the most, from where it is found
_WHAT = {
    ActsOn.DRIVE_ANGLE: (TIP, Place.DRIVE, "slips between drive and needle", "deg"),
    ActsOn.TIP_READING: (TIP, Place.SENSOR, "jumps of the tip sensor", "deg"),
    ActsOn.TORQUE_READING: (TORQUE, Place.SENSOR, "jumps of the torque sensor", "N mm"),
}


@dataclass(frozen=True, kw_only=True)
class _Step:
    """A step of a residual: its trial, s after the start of it, and what it takes off the cost."""

    trial: str
    time_s: float
    gain: float


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Steps of each angle or reading whose residual is mostly steps, of which a trial has several."""
    found = []
    for acts_on, (sensor, *_) in _WHAT.items():
        steps = _steps(ranges, sensor) if sensor in ranges.missing else ()
        trials = [step.trial for step in steps]
        if len(trials) > len(set(trials)):
            size = max(ranges.missing[sensor], ranges.problem.noise[sensor])
            found.append(_family(acts_on, steps, size))
    return tuple(found)


def _steps(ranges: LogRanges, sensor: str) -> tuple[_Step, ...]:
    """The largest steps of all trials, in the order of time; none: they are little of the residual."""
    noise, parts = ranges.problem.noise[sensor], dict[str, tuple[Array, Array]]()
    trials = [t for t in ranges.problem.log.trials if t.has(sensor)]
    for trial, left in zip(trials, ranges.left[sensor], strict=True):
        read = np.isfinite(left)
        parts[trial.name] = trial.time_s[read] - trial.time_s[0], left[read] / noise
    every = [step for name, part in parts.items() for step in _cut(name, *part)]
    largest = sorted(every, key=lambda step: -step.gain)[:STEPS_MOST]
    order = [*parts]
    found = tuple(sorted(largest, key=lambda step: (order.index(step.trial), step.time_s)))
    beyond = sum(float(np.sum(own**2)) - own.size for _, own in parts.values())
    after = sum(
        _left(*part, [step.time_s for step in found if step.trial == name])
        for name, part in parts.items()
    )
    return found if after < (1 - STEPS_SHARE) * beyond else ()


def _left(time_s: Array, left: Array, steps_s: Sequence[float]) -> float:
    """What steps leave of a residual beyond noise: it begins at 0, and has its mean after each."""
    first, *others = np.split(left, np.searchsorted(time_s, steps_s)) if steps_s else [left]
    after = sum(float(np.sum((part - part.mean()) ** 2)) for part in others if part.size)
    return float(np.sum(first**2)) + after - left.size


def _cut(trial: str, time_s: Array, left: Array) -> Iterator[_Step]:
    """Steps of a part of a trial."""
    if left.size < 2:
        return
    step = step_of(time_s - time_s[0], left)
    if step is None or step.gain < STEPS_GAIN:
        return
    yield _Step(trial=trial, time_s=float(time_s[step.sample]), gain=step.gain)
    for part in (slice(None, step.sample), slice(step.sample, None)):
        yield from _cut(trial, time_s[part], left[part])


def _family(acts_on: ActsOn, steps: Sequence[_Step], size: float) -> Family:
    _, place, title, unit = _WHAT[acts_on]
    name = f"{title}, several"
    return Family(
        effect=Effect(
            name=name,
            title=f"{title}, several in a log",
            place=place,
            parameters=(*map(_time, steps, range(len(steps))), *of_trials(len(steps), size)),
            apply=partial(_apply, acts_on, tuple(step.trial for step in steps)),
            differences=DIFFERENCES,
        ),
        places={place: 1.0},
        says="event",
        title=f"{title} in {steps[0].trial}",
        curve=partial(_first_trial, tuple(step.trial for step in steps)),
        x_unit="s",
        unit=unit,
    )


def _time(step: _Step, number: int) -> Parameter:
    return Parameter(
        name=f"time {number}",
        unit="s",
        low=max(0.0, step.time_s - _MOVES_S),
        high=step.time_s + _MOVES_S,
        start=(step.time_s,),
        scale=1.0,
        neutral=None,
        of_one_trial=True,
    )


def _of_trial(trials: Sequence[str], c: Sequence[float], trial: str) -> tuple[Array, Array]:
    """Places and values of the steps of a trial, in the order of time."""
    count = len(trials)
    own = sorted((c[i], c[count + i]) for i in range(count) if trials[i] == trial)
    times_s, sizes = np.array(own).T
    levels = np.concatenate([[0.0], np.cumsum(sizes)])
    begins = np.maximum(times_s - 0.5 * _LASTS_S, 0.0)
    places = np.stack([begins, times_s + 0.5 * _LASTS_S], axis=1).ravel()
    values = np.stack([levels[:-1], levels[1:]], axis=1).ravel()
    apart = _APART_S * np.arange(places.size)  # steps may come nearer to each other than they last
    return np.maximum.accumulate(places) + apart, values


def _first_trial(trials: Sequence[str], *c: float) -> Points:
    places, values = _of_trial(trials, c, trials[0])
    return (0.0, *places, float(places[-1]) + 2.0), (0.0, *values, float(values[-1]))


def _apply(acts_on: ActsOn, trials: Sequence[str], rig: RigParameters, *c: float) -> RigParameters:
    curves = []
    for trial in dict.fromkeys(trials):
        places, values = _of_trial(trials, c, trial)
        curves.append(
            Curve(
                acts_on=acts_on,
                variable=Variable.TIME,
                places=tuple(places),
                values=tuple(values),
                trial=trial,
            )
        )
    return replace(rig, free=FreeLaw(curves=tuple(curves)))

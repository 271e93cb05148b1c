"""An event in every trial: an angle or a reading steps once in each, by as much to either side.

Each time has a time of its own: a straight line over the durations of the trials, by its parameters,
and by the other coordinates what is off it, which takes a reason.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import null_space
from scipy.stats import theilslopes

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_time.events import (
    DIFFERENCES,
    STEPS,
    Moment,
    around,
    curves_of,
    events,
    started,
    stepped,
    times_of,
    unit_of,
)
from diagnosis.freeform.family import FARTHEST, Family, Points, coordinates
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters

Array = NDArray[np.float64]

_SAME = 1e-3  # durations whose range is less, of their mean, are one


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Steps of each angle or reading that the log shows in two trials at least."""
    found = []
    for acts_on, (sensor, place, title) in STEPS.items():
        moments = events(ranges, sensor) if sensor in ranges.missing else ()
        if len(moments) > 1:
            size = max(ranges.missing[sensor], ranges.problem.noise[sensor])
            each = _EveryTrial.at(moments, ranges)
            found.append(_steps(acts_on, place, title, each, moments[0], size))
    return tuple(found)


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
        unit=unit_of(acts_on),
    )


def _stepped_first(each: _EveryTrial, duration_s: float, *c: float) -> Points:
    *times, step = c
    return stepped(float(each.times_s(times)[0]), duration_s, step)


def _apply_to_each(
    acts_on: ActsOn, each: _EveryTrial, rig: RigParameters, duration_s: float, *c: float
) -> RigParameters:
    *times, step = c
    steps = (
        curves_of(acts_on, trial, (), around(float(time_s), duration_s), (0.0, float(way) * step))
        for trial, time_s, way in zip(each.trials, each.times_s(times), each.ways, strict=True)
    )
    return replace(rig, free=FreeLaw(curves=tuple(curve for one in steps for curve in one)))

"""Tissue that gives way, or grips, once in a trial, and recovers: a flush of saline, a drug.

Its torque is multiplied by 1 + (factor - 1) exp(-(t - time) / recovery) from an unknown time on, which
starts where that of a change that stays would (changes.py).
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_time.changes import largest_change
from diagnosis.freeform.families.in_time.events import DIFFERENCES, times_of
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

_STARTS = tuple((factor, after_s) for factor in (0.4, 1.8) for after_s in (3.0, 15.0))
_FALLS_S = 0.2  # in which it gives way
_AFTER = np.array([0.0, 0.03, 0.1, 0.2, 0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 4.0, 6.0])  # of the recovery


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the log is long enough and less damping was simulated."""
    moment = largest_change(ranges, stays=False) if ranges.softer else None
    if moment is None:
        return ()
    when, _ = times_of(moment)
    factors, after_s = zip(*_STARTS, strict=True)
    parameters = (
        replace(when, start=len(_STARTS) * when.start),
        Parameter(
            name="factor", unit="-", low=0.01, high=20.0, start=factors, logarithmic=True, neutral=1.0
        ),
        Parameter(
            name="recovery",
            unit="s",
            low=0.3,
            high=100.0,
            start=after_s,
            logarithmic=True,
            neutral=None,
        ),
    )
    return (
        Family(
            effect=Effect(
                name="tissue that gives way once and recovers",
                title=f"tissue that gives way or grips in {moment.trial}, and recovers",
                place=Place.INTERFACE,
                parameters=parameters,
                apply=partial(_apply, moment.trial),
                differences=DIFFERENCES,
                trial=moment.trial,
            ),
            places={Place.INTERFACE: 0.5, Place.TISSUE: 0.5},
            says="event",
            title=f"torque of the tissue in {moment.trial}",
            curve=_course,
            x_unit="s",
            unit="-",
        ),
    )


def _course(
    time_s: float, factor: float, recovery_s: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """Factor of the torque over the time of the trial."""
    begins = max(time_s - 0.5 * _FALLS_S, 0.0)
    places = begins + _FALLS_S + recovery_s * _AFTER
    values = 1.0 + (factor - 1.0) * np.exp(-_AFTER)
    values[-1] = 1.0
    before = (-1.0, begins)
    return (*before, *(float(x) for x in places)), (1.0, 1.0, *(float(v) for v in values))


def _apply(
    trial: str, rig: RigParameters, time_s: float, factor: float, recovery_s: float
) -> RigParameters:
    places, values = _course(time_s, factor, recovery_s)
    curve = Curve(
        acts_on=ActsOn.TISSUE, variable=Variable.TIME, places=places, values=values, trial=trial
    )
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=(curve,)))

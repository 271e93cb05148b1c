"""A clock that is off by more than clocks are: that of a sensor, or of the base against both sensors,

    what is read at t is that of t (1 + rate),    t from the start of a trial,

as of a sampling rate that was written down wrongly.
"""

from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.rig_parameters import RigParameters

_MOST, _USUAL = 0.3, 0.03
_STARTS = (0.02, -0.02, 0.035, -0.035, 0.05, -0.05, 0.07, -0.07, 0.1, -0.1)
_SENSOR: Mapping[Place, float] = {Place.SENSOR: 1.0}
_BASE: Mapping[Place, float] = {Place.SENSOR: 0.5, Place.DRIVE: 0.5}


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Of each sensor that was read; of the base, if both were."""
    read = tuple(sensor for sensor in (TIP, TORQUE) if sensor in ranges.missing)
    words = {TIP: "the tip sensor", TORQUE: "the torque sensor"}
    found = [_of((sensor,), words[sensor], _SENSOR, ranges) for sensor in read]
    return (*found, *([_of(read, "both sensors, against the base", _BASE, ranges)] if found[1:] else ()))


def _of(
    sensors: tuple[str, ...], words: str, places: Mapping[Place, float], ranges: LogRanges
) -> Family:
    return Family(
        effect=Effect(
            name=f"clock over time of {words}",
            title=f"a clock of {words} that is off",
            place=most_probable(places),
            parameters=(
                Parameter(name="rate", unit="-", low=-_MOST, high=_MOST, start=_STARTS, scale=_USUAL),
            ),
            apply=partial(_apply, sensors),
        ),
        places=places,
        says="time",
        title=f"time by which the clock of {words} is ahead",
        curve=partial(_ahead, max(float(np.ptp(trial.time_s)) for trial in ranges.problem.log.trials)),
        x_unit="s",
        unit="s",
    )


def _ahead(longest_s: float, rate: float) -> Points:
    """By how much a clock is ahead, s, over the time in a trial."""
    return (0.0, 0.5 * longest_s, longest_s), (0.0, 0.5 * rate * longest_s, rate * longest_s)


def _apply(sensors: tuple[str, ...], rig: RigParameters, rate: float) -> RigParameters:
    if TIP in sensors:
        rig = replace(rig, tip_clock_ratio=rig.tip_clock_ratio + rate)
    if TORQUE in sensors:
        rig = replace(rig, torque_clock_ratio=rig.torque_clock_ratio + rate)
    return rig

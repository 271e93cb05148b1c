"""A tip or torque sensor that shows a new value only once that is far enough from what it shows.

Each jump goes to the true value, so the next ones depend on all before: fits start from the distances at
which the readings of the nominal rig, held like this, leave least, and move by little.
"""

from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP, TORQUE
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.sensing.held_reading import held_back
from diagnosis.replay.variables import SAYS, Variable

_LEAST, _MOST = 0.5, 10.0  # distance over what is missing: a value held within it is off by 0.6 of it
_TRIED, _STARTS = 200, 4
_APART = 1.1  # distances of two starts, at least
_PLACES, _JUST = 5, 1.001  # of the step, on either side; a distance that is beyond it


@dataclass(frozen=True, kw_only=True)
class _Sensor:
    """A sensor: its column, what its curve acts on, and words."""

    column: str
    acts_on: ActsOn
    words: str
    unit: str


_SENSORS = (
    _Sensor(column=TIP, acts_on=ActsOn.TIP_READING, words="tip sensor", unit="deg"),
    _Sensor(column=TORQUE, acts_on=ActsOn.TORQUE_READING, words="torque sensor", unit="N mm"),
)


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """That of each sensor that was read."""
    return tuple(_held(own, ranges) for own in _SENSORS if ranges.missing.get(own.column))


def _held(sensor: _Sensor, ranges: LogRanges) -> Family:
    missing = ranges.missing[sensor.column]
    distance = Parameter(
        name="distance",
        unit=sensor.unit,
        low=0.5 * _LEAST * missing,
        high=2.0 * _MOST * missing,
        start=_starts(sensor, ranges),
        logarithmic=True,
        neutral=None,
    )
    return Family(
        effect=Effect(
            name=f"{sensor.acts_on.replace('_', ' ')} over held_by",
            title=f"a {sensor.words} that shows a value only once it is far from what is shown",
            place=Place.SENSOR,
            parameters=(distance,),
            apply=partial(_apply, sensor.acts_on),
            differences=(1e-2, 1e-3),
        ),
        places={Place.SENSOR: 1.0},
        says=SAYS[Variable.HELD_BY],
        title=f"change of a value that the {sensor.words} shows",
        curve=_shown,
        x_unit=f"{sensor.unit} from what is shown",
        unit=sensor.unit,
    )


def _starts(sensor: _Sensor, ranges: LogRanges) -> tuple[float, ...]:
    """Distances at which the nominal readings, if held, leave least, best first."""
    tried = np.geomspace(_LEAST, _MOST, _TRIED) * ranges.missing[sensor.column]
    found: list[float] = []
    for distance in sorted(map(float, tried), key=partial(_left, sensor.column, ranges)):
        if len(found) < _STARTS and all(max(distance, f) > _APART * min(distance, f) for f in found):
            found.append(distance)
    return tuple(found)


def _left(column: str, ranges: LogRanges, distance: float) -> float:
    """Sum of squares that nominal readings leave which are held up to a distance."""
    read = [
        own[column]
        for trial, own in zip(ranges.problem.log.trials, ranges.nominal, strict=True)
        if trial.has(column)
    ]
    each = zip(read, ranges.left[column], strict=True)
    return float(sum(np.nansum((left - held_back(true, distance)) ** 2) for true, left in each))


def _shown(distance: float) -> Points:
    """A step, since what is shown follows as soon as it is off by the distance."""
    up_to = np.linspace(0.0, distance, _PLACES)
    off = np.concatenate([up_to, _JUST * distance + up_to])
    return tuple(map(float, off)), (0.0,) * _PLACES + (distance,) * _PLACES


def _apply(acts_on: ActsOn, rig: RigParameters, distance: float) -> RigParameters:
    curve = Curve(
        acts_on=acts_on,
        variable=Variable.HELD_BY,
        places=(0.0, 1.0),
        values=(0.0, distance),
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))

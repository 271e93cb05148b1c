"""An encoder that counts differently each way, as a wheel does that slips where it is pulled,

    rate of the needle at the chuck = rate that is read (1 + forwards)      forwards
                                      rate that is read (1 + backwards)     backwards

so that its error adds up with every turn and back.
"""

from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.sensors.losing_counts import running_ahead
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models import units

_MOST, _SHARE, _USUAL = 0.5, 0.05, 0.02
_UP = (0.01, 0.02, 1.0, 2.0)  # of the fastest rate: straight but for a corner at rest


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the base turns."""
    if Variable.RATE not in ranges.ends:
        return ()
    fastest = max(abs(end) for end in ranges.ends[Variable.RATE])
    each = (
        Parameter(name="forwards", unit="-", low=-_MOST, high=_MOST, start=(_SHARE, 0.0), scale=_USUAL),
        Parameter(name="backwards", unit="-", low=-_MOST, high=_MOST, start=(0.0, _SHARE), scale=_USUAL),
    )
    return (
        Family(
            effect=Effect(
                name="drive slip over rate, each way",
                title="an encoder that counts differently each way",
                place=Place.DRIVE,
                parameters=each,
                apply=partial(_apply, fastest),
            ),
            places={Place.DRIVE: 0.5, Place.SENSOR: 0.5},
            says="direction",
            title="rate at which the drive runs ahead of its encoder",
            curve=partial(_ahead, fastest),
            x_unit="rad/s",
            unit="deg/s",
        ),
    )


def _ahead(
    fastest: float, forwards: float, backwards: float
) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """By how much faster than its encoder the drive turns, deg/s, over the rate that is read."""
    up = tuple(share * fastest for share in _UP)
    down = tuple(-rate for rate in reversed(up))
    added = (backwards * rate for rate in down), (forwards * rate for rate in up)
    return (*down, 0.0, *up), tuple(rate / units.DEG for rate in (*added[0], 0.0, *added[1]))


def _apply(fastest: float, rig: RigParameters, forwards: float, backwards: float) -> RigParameters:
    return running_ahead(rig, *_ahead(fastest, forwards, backwards))

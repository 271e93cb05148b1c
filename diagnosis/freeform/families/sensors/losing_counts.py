"""A drive that falls behind its encoder, or an encoder that loses counts, where it turns fast.

    rate of the needle at the chuck = rate that is read                      up to a rate, either way
                                      rate that is read (1 + share)          beyond it

A smooth curve over the rate has no such jump.
"""

from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models import units

_LEAST, _CORNER, _FAR = 0.03, 0.01, 2.0  # in the fastest rate
_SHARE = 0.3
_STARTS = tuple((level, share) for level in (0.2, 0.4, 0.6, 0.8) for share in (_SHARE, -_SHARE))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the base turns."""
    if Variable.RATE not in ranges.ends:
        return ()
    fastest = max(abs(end) for end in ranges.ends[Variable.RATE])
    levels, shares = zip(*_STARTS, strict=True)
    level = Parameter(
        name="level",
        unit="rad/s",
        low=_LEAST * fastest,
        high=fastest,
        start=tuple(own * fastest for own in levels),
        logarithmic=True,
        neutral=None,
    )
    share = Parameter(name="share", unit="-", low=-0.9, high=9.0, start=shares, scale=_SHARE)
    return (
        Family(
            effect=Effect(
                name="drive slip over rate, beyond a level",
                title="an encoder that loses counts where it turns fast",
                place=Place.DRIVE,
                parameters=(level, share),
                apply=partial(_apply, fastest),
                differences=(1e-1, 1e-2),
            ),
            places={Place.DRIVE: 0.5, Place.SENSOR: 0.5},
            says=Variable.RATE,
            title="rate at which the drive runs ahead of its encoder",
            curve=partial(_ahead, fastest),
            x_unit="rad/s",
            unit="deg/s",
        ),
    )


def _ahead(fastest: float, level: float, share: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    """By how much faster than its encoder the drive turns, deg/s, over the rate that is read."""
    corner = _CORNER * fastest
    up = (level, *(level + more for more in (corner, 2.0 * corner, fastest, _FAR * fastest)))
    added = [0.0, *(share * rate / units.DEG for rate in up[1:])]
    return tuple(-x for x in reversed(up)) + up, tuple(-y for y in reversed(added)) + tuple(added)


def _apply(fastest: float, rig: RigParameters, level: float, share: float) -> RigParameters:
    return running_ahead(rig, *_ahead(fastest, level, share))


def running_ahead(
    rig: RigParameters, rates: tuple[float, ...], ahead: tuple[float, ...]
) -> RigParameters:
    """The rig whose drive turns faster than its encoder, by so many deg/s at rates that are read."""
    curve = Curve(
        acts_on=ActsOn.DRIVE_SLIP,
        variable=Variable.RATE,
        places=rates,
        values=tuple(-value for value in ahead),
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))

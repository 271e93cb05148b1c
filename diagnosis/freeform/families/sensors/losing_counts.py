"""An encoder that loses counts where it turns fast, or a drive that falls behind its encoder there.

    rate of the needle at the chuck = rate that is read                      up to a rate, either way
                                      rate that is read (1 + share)          beyond it,
                                      or rate that is read + share (its excess)

    rate that is read at the tip = rate of the tip                           up to a rate, either way
                                   rate of the tip + share (its excess)      beyond it

A smooth curve over the rate has no such jump.
"""

from collections.abc import Callable, Sequence
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

Points = tuple[Sequence[float], Sequence[float]]

_LEAST, _CORNER, _FAR = 0.03, 0.01, 2.0  # in the fastest rate
_SHARE = 0.3
_STARTS = tuple((level, share) for level in (0.2, 0.4, 0.6, 0.8) for share in (_SHARE, -_SHARE))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The laws of the base, and that of the tip, if they turn."""
    makes = {Variable.RATE: (_of_base, _of_excess), Variable.TIP_RATE: (_of_tip,)}
    fastest = {v: max(abs(end) for end in ranges.ends[v]) for v in makes if v in ranges.ends}
    return tuple(make(most) for variable, most in fastest.items() for make in makes[variable])


def _of_base(fastest: float) -> Family:
    return _of_drive(
        fastest,
        "drive slip over rate, beyond a level",
        "an encoder that loses counts where it turns fast",
        _ahead,
    )


def _of_excess(fastest: float) -> Family:
    return _of_drive(
        fastest,
        "drive slip over rate, by the excess over a level",
        "an encoder that loses the more counts the faster it turns",
        _excess,
    )


def _of_drive(fastest: float, name: str, title: str, ahead: Callable[..., Points]) -> Family:
    return Family(
        effect=Effect(
            name=name,
            title=title,
            place=Place.DRIVE,
            parameters=_parameters(fastest),
            apply=partial(_apply, ahead, fastest),
            differences=(1e-1, 1e-2),
        ),
        places={Place.DRIVE: 0.5, Place.SENSOR: 0.5},
        says=Variable.RATE,
        title="rate at which the drive runs ahead of its encoder",
        curve=partial(ahead, fastest),
        x_unit="rad/s",
        unit="deg/s",
    )


def _of_tip(fastest: float) -> Family:
    return Family(
        effect=Effect(
            name="tip counts over rate, beyond a level",
            title="a counter of the tip's angle that loses counts where it turns fast",
            place=Place.SENSOR,
            parameters=_parameters(fastest),
            apply=partial(_apply_to_tip, fastest),
            differences=(1e-1, 1e-2),
        ),
        places={Place.SENSOR: 1.0},
        says=Variable.RATE,
        title="rate at which the tip sensor runs ahead of the tip",
        curve=partial(_excess, fastest),
        x_unit="rad/s",
        unit="deg/s",
    )


def _parameters(fastest: float) -> tuple[Parameter, Parameter]:
    """Rate beyond which counts are lost, and the share of them."""
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
    return level, Parameter(name="share", unit="-", low=-0.9, high=9.0, start=shares, scale=_SHARE)


def _ahead(fastest: float, level: float, share: float) -> Points:
    """By how much faster than its encoder the drive turns, deg/s, over the rate that is read."""
    rates = _beyond(fastest, level)
    return _either_way(rates, [0.0, *(share * rate for rate in rates[1:])])


def _excess(fastest: float, level: float, share: float) -> Points:
    """The same by a share of the excess alone; or of the sensor of the tip, over the rate of the tip."""
    rates = _beyond(fastest, level)
    return _either_way(rates, [share * (rate - level) for rate in rates])


def _beyond(fastest: float, level: float) -> list[float]:
    """Rates from a level on, between which a smooth curve is straight."""
    corner = _CORNER * fastest
    return [level, *(level + more for more in (corner, 2.0 * corner, fastest, _FAR * fastest))]


def _either_way(rates: Sequence[float], more: Sequence[float]) -> Points:
    """A curve in deg/s over rates of either sign."""
    back = [-rate for rate in reversed(rates)], [-value / units.DEG for value in reversed(more)]
    return (*back[0], *rates), (*back[1], *(value / units.DEG for value in more))


def _apply(
    ahead: Callable[..., Points], fastest: float, rig: RigParameters, level: float, share: float
) -> RigParameters:
    return running_ahead(rig, *ahead(fastest, level, share))


def _apply_to_tip(fastest: float, rig: RigParameters, level: float, share: float) -> RigParameters:
    rates, ahead = _excess(fastest, level, share)
    curve = Curve(
        acts_on=ActsOn.TIP_COUNTS,
        variable=Variable.TIP_RATE,
        places=tuple(rates),
        values=tuple(ahead),
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))


def running_ahead(rig: RigParameters, rates: Sequence[float], ahead: Sequence[float]) -> RigParameters:
    """The rig whose drive turns faster than its encoder, by so many deg/s at rates that are read."""
    curve = Curve(
        acts_on=ActsOn.DRIVE_SLIP,
        variable=Variable.RATE,
        places=tuple(rates),
        values=tuple(-value for value in ahead),
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))

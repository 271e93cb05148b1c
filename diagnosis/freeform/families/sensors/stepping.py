"""A tip sensor whose error has the sign of the rate, as of one that is coupled with friction,

    reading = tip angle + height tanh(rate / width),

which a smooth curve over the rate follows only where the rate is large.
"""

from dataclasses import replace

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family
from diagnosis.freeform.ranges import LogRanges
from diagnosis.log.trial import TIP
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable

_WIDTHS_RAD_S = (0.05, 0.05, 0.3, 0.3)  # to start with, either sign of the height
_ENDS = (0.05, 5.0)  # widths, within which the step is drawn
_PLACES = 8  # either side of rest
_MOST = 10.0  # times what is missing


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the tip was read and turns."""
    if TIP not in ranges.missing or Variable.TIP_RATE not in ranges.ends:
        return ()
    size = ranges.missing[TIP]
    return (_step(size),)


def _step(size: float) -> Family:
    height = Parameter(
        name="height",
        unit="deg",
        low=-_MOST * size,
        high=_MOST * size,
        start=(size, -size) * 2,
        scale=size,
    )
    width = Parameter(
        name="width",
        unit="rad/s",
        low=0.003,
        high=1.0,
        start=_WIDTHS_RAD_S,
        logarithmic=True,
        neutral=None,
    )
    return Family(
        effect=Effect(
            name="tip reading over tip_rate, as a step",
            title="an error of the tip sensor with the sign of the rate",
            place=Place.SENSOR,
            parameters=(height, width),
            apply=_apply,
            differences=(1e-1, 1e-2),
        ),
        places={Place.SENSOR: 1.0},
        says="direction",
        title="error of the tip sensor",
        curve=_stepped,
        x_unit=UNITS[Variable.TIP_RATE],
        unit="deg",
    )


def _stepped(height: float, width: float) -> tuple[tuple[float, ...], tuple[float, ...]]:
    up = width * np.geomspace(*_ENDS, _PLACES)
    rates = np.concatenate([-up[::-1], [0.0], up])
    return tuple(map(float, rates)), tuple(map(float, height * np.tanh(rates / width)))


def _apply(rig: RigParameters, height: float, width: float) -> RigParameters:
    rates, errors = _stepped(height, width)
    curve = Curve(
        acts_on=ActsOn.TIP_READING,
        variable=Variable.TIP_RATE,
        places=rates,
        values=errors,
    )
    return replace(rig, free=FreeLaw(curves=(curve,)))

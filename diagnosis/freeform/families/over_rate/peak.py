"""Damping that is stronger, or weaker, around one rate of slipping,

    damping = nominal (1 + height exp(-(ln(rate / at) / width)^2)),

as of rubber and gels, whose friction peaks at a rate (Grosch, Proc. R. Soc. Lond. A 274 (1963)). A curve
over all rates of a log is too coarse for that.
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Parameter
from diagnosis.freeform.families.over_rate.friction import at_one_rate, damping_over_rate
from diagnosis.freeform.family import Family, Points
from diagnosis.freeform.ranges import LogRanges
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from models.tissue import RATE_POINTS

_LOWEST, _HIGHEST = -0.95, 20.0  # height of a peak
_NARROWEST, _WIDEST = 0.2, 2.0  # in the logarithm of the rate
_HEIGHTS, _WIDTH = (0.5, -0.3), 0.7  # to start with
_AT = (0.25, 0.5, 0.75)  # of the logarithm of the rates
_REACH = 2.5  # widths either side, beyond which nothing of a peak is left: 0.2 %


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law."""
    law = damping_over_rate(
        name="around one rate",
        title="damping that is stronger or weaker around one rate of turning",
        parameters=_parameters(ranges),
        apply=_apply,
        curve=partial(_damping, ranges.damping_n_mm_s_per_mm),
    )
    return (law,)


def _parameters(ranges: LogRanges) -> tuple[Parameter, ...]:
    heights, rate = at_one_rate(ranges, _HEIGHTS, _AT)
    height = Parameter(name="height", unit="-", low=_LOWEST, high=_HIGHEST, start=heights)
    width = Parameter(
        name="width",
        unit="-",
        low=_NARROWEST,
        high=_WIDEST,
        start=(_WIDTH,) * len(heights),
        logarithmic=True,
        neutral=None,
    )
    return height, rate, width


def _rates(rate_rad_s: float, width: float) -> tuple[float, float]:
    reach = float(np.exp(_REACH * width))
    return rate_rad_s / reach, rate_rad_s * reach


def _factors(height: float) -> tuple[float, ...]:
    """At `RATE_POINTS` rates from end to end."""
    widths = np.linspace(-_REACH, _REACH, RATE_POINTS)
    return tuple(float(f) for f in 1.0 + height * np.exp(-(widths**2)))


def _damping(beta: float, height: float, rate_rad_s: float, width: float) -> Points:
    rates = np.geomspace(*_rates(rate_rad_s, width), RATE_POINTS)
    return rates, beta * np.array(_factors(height))


def _apply(rig: RigParameters, height: float, rate_rad_s: float, width: float) -> RigParameters:
    free = FreeLaw(rate_curve=_factors(height), rate_range_rad_s=_rates(rate_rad_s, width))
    return replace(rig, free=free)

"""Viscous torque that grows otherwise beyond one rate of slipping,

    torque = damping rate                              up to it,
    torque = damping (at + slope (rate - at))          beyond,

as of a film of fluid that breaks down, or of a layer at the shaft that slips (slope near 0). A curve
over all rates of a log rounds the corner off.
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

_LEAST, _MOST = 0.01, 10.0  # slope
_SLOPES = (0.3, 3.0)  # to start with
_AT = (0.5, 0.8)  # of the logarithm of the rates
_REACH = 10.0  # rates beyond which the factor hardly changes, in the first


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law."""
    law = damping_over_rate(
        name="beyond one rate",
        title="viscous torque that grows otherwise beyond one rate of turning",
        parameters=_parameters(ranges),
        apply=_apply,
        curve=partial(_damping, ranges.damping_n_mm_s_per_mm),
    )
    return (law,)


def _parameters(ranges: LogRanges) -> tuple[Parameter, ...]:
    slopes, rate = at_one_rate(ranges, _SLOPES, _AT)
    slope = Parameter(
        name="slope", unit="-", low=_LEAST, high=_MOST, start=slopes, logarithmic=True, neutral=1.0
    )
    return slope, rate


def _rates(rate_rad_s: float) -> tuple[float, float]:
    return rate_rad_s, _REACH * rate_rad_s


def _factors(slope: float) -> tuple[float, ...]:
    """At `RATE_POINTS` rates from the first one on, in the units of which it is 1."""
    at = np.geomspace(1.0, _REACH, RATE_POINTS)
    return tuple(float(f) for f in (1.0 + slope * (at - 1.0)) / at)


def _damping(beta: float, slope: float, rate_rad_s: float) -> Points:
    rates = np.geomspace(*_rates(rate_rad_s), RATE_POINTS)
    return rates, beta * np.array(_factors(slope))


def _apply(rig: RigParameters, slope: float, rate_rad_s: float) -> RigParameters:
    free = FreeLaw(rate_curve=_factors(slope), rate_range_rad_s=_rates(rate_rad_s))
    return replace(rig, free=free)

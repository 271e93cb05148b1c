"""Friction over the rate at which each piece of shaft slips: dry, and a factor of the damping."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import INTERFACE
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates_of, from_neutral
from diagnosis.freeform.ranges import LEAST_RANGE, LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.tissue import Interface

PLACES = 12
SLOWEST, FASTEST = 0.003, 1.25  # ends of a curve over rate, in the fastest slip of the nominal shaft


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law."""
    return (_friction_over_rate(ranges),)


def rates_of(ranges: LogRanges) -> tuple[float, float]:
    """Lowest and highest rate of a curve over the rate of each piece of shaft, rad/s."""
    fastest = max(ranges.fastest_slip_rad_s, LEAST_RANGE[Variable.RATE])
    return SLOWEST * fastest, FASTEST * fastest


def at_one_rate(
    ranges: LogRanges, sizes: Sequence[float], shares: Sequence[float]
) -> tuple[tuple[float, ...], Parameter]:
    """Starts of the size of a law at one rate, and that rate: each size at each share of all rates.

    Args:
      shares: of the logarithm of the rates, from the slowest to the fastest.
    """
    slowest, fastest = rates_of(ranges)
    starts = [(size, slowest * (fastest / slowest) ** share) for size in sizes for share in shares]
    each, rates = zip(*starts, strict=True)
    rate = Parameter(
        name="rate",
        unit="rad/s",
        low=slowest,
        high=fastest,
        start=rates,
        logarithmic=True,
        neutral=None,
    )
    return each, rate


def damping_over_rate(
    name: str,
    title: str,
    parameters: tuple[Parameter, ...],
    apply: Callable[..., RigParameters],
    curve: Callable[..., Points],
) -> Family:
    """A law that multiplies the damping by a factor over the rate."""
    return Family(
        effect=Effect(
            name=f"damping over rate, {name}",
            title=title,
            place=Place.INTERFACE,
            parameters=parameters,
            apply=apply,
        ),
        places=INTERFACE,
        says="rate",
        title="damping along the shaft",
        curve=curve,
        x_unit="rad/s",
        unit=VISCOUS,
    )


def _friction_over_rate(ranges: LogRanges) -> Family:
    rates = rates_of(ranges)
    curve = ranges.in_detail(smooth_curve(0.0, 1.0, PLACES))
    beta = ranges.damping_n_mm_s_per_mm

    return Family(
        effect=Effect(
            name="friction over rate",
            title="friction that changes with the rate of turning",
            place=Place.INTERFACE,
            parameters=(ranges.dry_level, *from_neutral(coordinates_of(curve), ranges.dry_level)),
            apply=partial(_apply_rate, curve, rates),
            differences=(1e-2,),
        ),
        places=INTERFACE,
        says="rate",
        title="friction along the shaft",
        curve=partial(_friction, curve, rates, beta),
        x_unit="rad/s",
        unit="N mm / mm",
        as_effect={"shear_thinning": partial(_power_law, curve, rates, ranges.dry_level.low)},
        contains=("coulomb_friction", "speed_dependent_friction", "stiction"),
    )


def _power_law(
    curve: SmoothCurve, rates: tuple[float, float], level: float, exponent: float, plateau: float
) -> tuple[float, ...]:
    """The least dry friction, and the coordinates of a power law that is viscous below its plateau."""
    at = np.geomspace(*rates, curve.places.size)
    return level, *curve.coordinates(0.5 * (exponent - 1.0) * np.log(at**2 + plateau**2))


def _friction(
    curve: SmoothCurve, rates: tuple[float, float], beta: float, level: float, *c: float
) -> Points:
    at = np.geomspace(*rates, curve.places.size)
    return at, level + beta * at * np.array(curve.factors(c))


def _apply_rate(
    curve: SmoothCurve, rates: tuple[float, float], rig: RigParameters, level: float, *c: float
) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level)
    free = FreeLaw(rate_curve=curve.factors(c), rate_range_rad_s=rates, throughout=(law,))
    return replace(rig, free=free)

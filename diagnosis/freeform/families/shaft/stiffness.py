"""Free laws of the stiffness of the shaft.

- a curve of the torque that it carries, either way
- a curve of the place along it: a joint, a thinner or a hollow part
- a curve of the time: a shaft that is warmed, or cracks
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, rough_curve, smooth_curve, two_sided_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models.needle import STIFFNESS_POINTS

_BEYOND = 1.5  # torque that a curve spans / that of the nominal shaft: one that yields twists more
_STIFFENS = 0.5  # of the logarithm of the stiffness, to start with
_PARTS = 10  # of the longest shaft


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws of a stiffness that changes."""
    if Variable.TORQUE not in ranges.ends:
        return ()
    of_time = (_over(v, ranges) for v in (Variable.TIME, Variable.TRIAL_SHARE) if v in ranges.ends)
    return (_over_torque(ranges), _along(ranges), *of_time)


def _over_torque(ranges: LogRanges) -> Family:
    most_n_mm = _BEYOND * max(abs(end) for end in ranges.ends[Variable.TORQUE])
    curve = two_sided_curve(most_n_mm, STIFFNESS_POINTS)
    return Family(
        effect=Effect(
            name="stiffness over torque",
            title="a shaft whose stiffness changes with the torque that it carries",
            place=Place.NEEDLE,
            parameters=_either_way(coordinates_of(curve)),
            apply=partial(_apply_stiffness, curve, most_n_mm),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit="N mm",
        unit="-",
    )


def _either_way(parameters: Sequence[Parameter]) -> tuple[Parameter, ...]:
    """Parameters of a shaft that starts as one that is stiffer, or softer, under a large torque."""
    level, size, *rest = (replace(p, start=(0.0, 0.0)) for p in parameters)
    return (level, replace(size, start=(_STIFFENS, -_STIFFENS)), *rest)


def _factors(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.factors(c)


def _by_sign(factors: Sequence[float]) -> tuple[float, ...]:
    """Of negative torques from 0, then of positive ones; they come in the order of the torques."""
    negative, positive = factors[:STIFFNESS_POINTS], factors[STIFFNESS_POINTS:]
    return (*negative[::-1], *positive)


def _apply_stiffness(
    curve: SmoothCurve, most_n_mm: float, rig: RigParameters, *c: float
) -> RigParameters:
    factors = _by_sign(curve.factors(c))
    shaft = FreeShaft(stiffness_curve=factors, stiffness_torque_n_mm=most_n_mm)
    return replace(rig, free=FreeLaw(shaft=shaft))


def _along(ranges: LogRanges) -> Family:
    curve = rough_curve(0.0, ranges.longest_mm, _PARTS)
    return Family(
        effect=Effect(
            name="stiffness over position",
            title="a shaft whose stiffness changes along it",
            place=Place.NEEDLE,
            parameters=coordinates_of(curve),
            apply=partial(_apply_along, curve),
        ),
        places={Place.NEEDLE: 1.0},
        says="position",
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit="mm from the tip",
        unit="-",
    )


def _apply_along(curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    last_mm = float(curve.places[-1])
    shaft = FreeShaft(stiffness_along=curve.factors(c), stiffness_along_mm=last_mm)
    return replace(rig, free=FreeLaw(shaft=shaft))


def _over(variable: Variable, ranges: LogRanges) -> Family:
    curve = smooth_curve(*ranges.ends[variable])
    return Family(
        effect=Effect(
            name=f"stiffness over {variable}",
            title=f"a shaft whose stiffness changes with {variable}",
            place=Place.PARAMETERS,
            parameters=coordinates_of(curve),
            apply=partial(_apply_over, variable, curve),
        ),
        places={Place.PARAMETERS: 0.6, Place.NEEDLE: 0.4},
        says=SAYS.get(variable, variable),
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit=UNITS[variable],
        unit="-",
    )


def _apply_over(variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    own = curve.acting_on(ActsOn.STIFFNESS, variable, c)
    return replace(rig, free=FreeLaw(tissue_varies=True, curves=(own,)))

"""Free laws of the interface between shaft and tissue, per mm of shaft.

- damping times a curve of time, axial speed, depth, or place along the shaft, or of the base angle,
  also once a turn
- nominal damping, and dry friction as a curve of these, or of the base angle
- damping and dry friction that differ between the directions
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import (
    VISCOUS,
    Family,
    Points,
    coordinates_of,
    from_neutral,
    most_probable,
)
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, jumping_curve, periodic_curve, smooth_curve
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models.tissue import Interface

OVER = (Variable.TIME, Variable.TRIAL_SHARE, Variable.AXIAL_SPEED, Variable.DEPTH)
LATELY = (Variable.SLID_LATELY, Variable.PUSHED_LATELY, Variable.RESTED)
DAMPING_OVER = (*OVER, *LATELY, Variable.BASE_ANGLE, Variable.TRAVELLED)
FRICTION_OVER = (*OVER, *LATELY, Variable.BASE_ANGLE, Variable.TRAVELLED)
FADING = (Variable.TIME, Variable.HISTORY, Variable.TRAVELLED, Variable.RESTED)
SLOW_RAD_S = 0.03
LEAST_PART = 0.02  # of the nominal damping
PARTS = 6  # of the inserted length
TURN_DEG, WAVES = 360.0, 8
INTERFACE = {Place.INTERFACE: 1.0}
DAMPING = {Place.TISSUE: 0.55, Place.INTERFACE: 0.45}
"""Damping that differs from place to place is likelier that of the tissue, as in layers."""
FILM = {Place.INTERFACE: 0.55, Place.TISSUE: 0.45}
"""Damping that changes with time, or with how the shaft slides or slips, is likelier that of the film
around it, which dries or warms."""
_OF_FILM = (Variable.TIME, Variable.TRIAL_SHARE, Variable.AXIAL_SPEED, *LATELY)
_WHEN = dict.fromkeys(LATELY, " after sliding")
_SIDE = Parameter(name="asymmetry", unit="-", low=-0.95, high=0.95, start=(0.0, 0.3, -0.3))


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that may be missing between shaft and tissue."""
    curves = {v: curve_over(v, ranges) for v in DAMPING_OVER if v in ranges.ends}
    damping = (_damping_over(v, curve, ranges) for v, curve in curves.items())
    friction = (_friction_over(v, ranges) for v in FRICTION_OVER if v in ranges.ends)
    turned = Variable.BASE_ANGLE in ranges.ends
    turn = (
        (_damping_over(Variable.BASE_ANGLE, periodic_curve(TURN_DEG, WAVES), ranges),) if turned else ()
    )
    return (*damping, *turn, *friction, _direction(ranges), _position(ranges))


def curve_over(variable: Variable, ranges: LogRanges) -> SmoothCurve:
    """A smooth curve over the range of the log; of the axial speed, one that may jump at rest."""
    ends = ranges.ends[variable]
    if variable is Variable.AXIAL_SPEED:
        return jumping_curve(*ends)
    return ranges.in_detail(smooth_curve(*ends, fading=variable in FADING))


def _damping_over(variable: Variable, curve: SmoothCurve, ranges: LogRanges) -> Family:
    beta = ranges.damping_n_mm_s_per_mm
    places = INTERFACE if variable is Variable.BASE_ANGLE else DAMPING
    places = FILM if variable in _OF_FILM else places
    once_a_turn = f", every {curve.period:.3g} deg" if curve.period else ""

    return Family(
        effect=Effect(
            name=f"damping over {variable}{once_a_turn}",
            title=f"damping that changes with {variable}",
            place=most_probable(places),
            parameters=coordinates_of(curve),
            apply=partial(_apply_damping, variable, curve),
        ),
        places=places,
        says=SAYS.get(variable, variable),
        title="damping along the shaft" + _WHEN.get(variable, ""),
        curve=partial(_damping, curve, beta),
        x_unit=UNITS[variable],
        unit=VISCOUS,
    )


def _damping(curve: SmoothCurve, beta: float, *c: float) -> Points:
    return curve.places, beta * np.array(curve.factors(c))


def _apply_damping(
    variable: Variable, curve: SmoothCurve, rig: RigParameters, *c: float
) -> RigParameters:
    return replace(
        rig, free=FreeLaw(tissue_varies=True, curves=(curve.acting_on(ActsOn.TISSUE, variable, c),))
    )


def _friction_over(variable: Variable, ranges: LogRanges) -> Family:
    curve = curve_over(variable, ranges)

    return Family(
        effect=Effect(
            name=f"dry friction over {variable}",
            title=f"dry friction that changes with {variable}",
            place=Place.INTERFACE,
            parameters=(ranges.dry_level, *from_neutral(coordinates_of(curve), ranges.dry_level)),
            apply=partial(_apply_friction, variable, curve),
            differences=(1e-2,),
        ),
        places=INTERFACE,
        says=SAYS.get(variable, variable),
        title="dry friction along the shaft" + _WHEN.get(variable, ""),
        curve=partial(_dry_level, curve),
        x_unit=UNITS[variable],
        unit="N mm / mm",
    )


def _dry_level(curve: SmoothCurve, level: float, *c: float) -> Points:
    return curve.places, level * np.array(curve.factors(c))


def _apply_friction(
    variable: Variable, curve: SmoothCurve, rig: RigParameters, level: float, *c: float
) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, varies=True)
    return replace(
        rig, free=FreeLaw(throughout=(law,), curves=(curve.acting_on(ActsOn.TISSUE, variable, c),))
    )


def _direction(ranges: LogRanges) -> Family:
    beta = ranges.damping_n_mm_s_per_mm

    return Family(
        effect=Effect(
            name="friction over direction",
            title="friction that is stronger one way than the other",
            place=Place.INTERFACE,
            parameters=(
                ranges.dry_level,
                _SIDE,
                replace(_SIDE, name="viscous asymmetry", start=(0.0, 0.0, 0.0)),
            ),
            apply=_apply_direction,
            differences=(1e-2,),
        ),
        places=INTERFACE,
        says="direction",
        title=f"friction along the shaft at {SLOW_RAD_S:g} rad/s",
        curve=partial(_both_ways, beta),
        x_unit="-",
        unit="N mm / mm",
    )


def _both_ways(beta: float, level: float, dry: float, viscous: float) -> Points:
    slow = beta * SLOW_RAD_S
    return (-1.0, 1.0), [level * (1 + s * dry) + slow * (1 + s * viscous) for s in (-1, 1)]


def _apply_direction(rig: RigParameters, level: float, dry: float, viscous: float) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, asymmetry=dry)
    return replace(rig, free=FreeLaw(throughout=(law,), asymmetry=viscous))


def _position(ranges: LogRanges) -> Family:
    curve = smooth_curve(0.0, 1.0, PARTS)
    beta = ranges.damping_n_mm_s_per_mm

    return Family(
        effect=Effect(
            name="damping over position",
            title="damping that changes along the inserted shaft",
            place=Place.TISSUE,
            parameters=coordinates_of(curve),
            apply=partial(_apply_position, curve),
        ),
        places={Place.TISSUE: 0.6, Place.INTERFACE: 0.4},
        says="position",
        title="damping along the shaft",
        curve=partial(_along_depth, curve, beta),
        x_unit="of the inserted length",
        unit=VISCOUS,
    )


def _along_depth(curve: SmoothCurve, beta: float, *c: float) -> Points:
    return (np.arange(PARTS) + 0.5) / PARTS, beta * np.array(_parts(curve, c))


def _parts(curve: SmoothCurve, c: Sequence[float]) -> tuple[float, ...]:
    """Factors of equal parts of the inserted length: 1 + curve; a linear gradient is straight."""
    return tuple(max(1.0 + v, LEAST_PART) for v in curve.values(c))


def _apply_position(curve: SmoothCurve, rig: RigParameters, *c: float) -> RigParameters:
    return replace(rig, free=FreeLaw(along_depth=AlongDepth(damping=_parts(curve, c))))

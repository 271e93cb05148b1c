"""Free laws of the tip.

- drag times a curve of the rate, and dry friction, which may differ between the directions
- dry friction that twists before it slips, as in a pocket of tissue that holds the bevel
- drag and dry friction times a curve of the time, the axial speed or the inserted length, as of a bevel
  that cuts, of how far the base has turned, as of fibres that wind up, or of the angle, once a turn
"""

from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import (
    SLOW_RAD_S,
    TURN_DEG,
    WAVES,
    curve_over,
)
from diagnosis.freeform.families.over_rate.friction import PLACES, rates_of
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, periodic_curve, smooth_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

AT_TIP_MM = 30.0  # of shaft, whose dry friction is as strong as one may start with at the tip
TORQUE_OVER = (Variable.TIME, Variable.AXIAL_SPEED, Variable.DEPTH, Variable.HISTORY)
_SAYS = {Variable.BASE_ANGLE: "tip_angle"}  # which follows that of the base, and is not known before
_TWISTS_DEG = (5.0, 20.0, 60.0)  # to start with
_SHOWN_RAD_S = np.array([-1.0, -0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 1.0])


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that the tip may lack."""
    curves = {v: curve_over(v, ranges) for v in TORQUE_OVER if v in ranges.ends}
    if Variable.BASE_ANGLE in ranges.ends:
        curves[Variable.BASE_ANGLE] = periodic_curve(TURN_DEG, WAVES)
    changing = (_torque_over(v, curve, ranges) for v, curve in curves.items())
    held = (_held(ranges),) if Variable.BASE_ANGLE in ranges.ends else ()
    return (_tip_rate(ranges), *held, *changing)


def _held(ranges: LogRanges) -> Family:
    dry, starts = dry_at_tip(ranges), len(_TWISTS_DEG)
    twist = Parameter(
        name="twist", unit="deg", low=0.5, high=180.0, start=_TWISTS_DEG, logarithmic=True, neutral=None
    )
    return Family(
        effect=Effect(
            name="tip torque over turned_by",
            title="dry friction at the tip that twists before it slips",
            place=Place.NEEDLE,
            parameters=(replace(dry, start=dry.start[-1:] * starts), twist),
            apply=_apply_held,
            differences=(1e-1, 1e-2),
        ),
        places={Place.NEEDLE: 0.7, Place.TISSUE: 0.3},
        says="history",
        title="dry friction at the tip after it has turned back",
        curve=_twisted,
        x_unit="deg",
        unit="N mm",
    )


def _twisted(level: float, twist_deg: float) -> Points:
    return (0.0, twist_deg, 2.0 * twist_deg), (0.0, level, level)


def _apply_held(rig: RigParameters, level: float, twist_deg: float) -> RigParameters:
    stiffness = level / np.radians(twist_deg)
    law = Interface(kinetic_n_mm_per_mm=level, stiffness_n_mm_per_rad_per_mm=float(stiffness))
    return replace(rig, free=FreeLaw(at_tip=(law,)))


def _tip_rate(ranges: LogRanges) -> Family:
    dry, rates = dry_at_tip(ranges), rates_of(ranges)
    curve = ranges.in_detail(smooth_curve(0.0, 1.0, PLACES))
    neutral = (0.0,) * len(dry.start)
    return Family(
        effect=Effect(
            name="tip torque over rate",
            title="drag and dry friction in one place, at the tip",
            place=Place.NEEDLE,
            parameters=(
                _drag(ranges, len(dry.start)),
                dry,
                Parameter(name="asymmetry", unit="-", low=-0.95, high=0.95, start=neutral),
                *(replace(p, start=neutral) for p in coordinates_of(curve)),
            ),
            apply=partial(_apply_tip_rate, curve, rates),
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="rate",
        title="torque at the tip",
        curve=partial(_at_rates, curve, rates),
        x_unit="rad/s",
        unit="N mm",
    )


def _at_rates(
    curve: SmoothCurve,
    rates: tuple[float, float],
    damping: float,
    level: float,
    side: float,
    *c: float,
) -> Points:
    places = np.log(np.geomspace(*rates, curve.places.size))
    at = np.interp(np.log(np.abs(_SHOWN_RAD_S)), places, curve.values(c))
    own = damping * np.exp(at) * _SHOWN_RAD_S + level * np.sign(_SHOWN_RAD_S)
    return _SHOWN_RAD_S, own * (1 + side * np.sign(_SHOWN_RAD_S))


def _drag(ranges: LogRanges, starts: int) -> Parameter:
    """Drag at the tip, which may be 0, but does not start there: of none, a curve changes nothing."""
    own = ranges.library["tip_drag"].parameters[0]
    usual = own.start[0]
    return Parameter(
        name=own.name, unit=own.unit, low=0.0, high=own.high, start=(usual,) * starts, scale=usual
    )


def dry_at_tip(ranges: LogRanges) -> Parameter:
    """Dry friction at the tip, in the range of what `AT_TIP_MM` of shaft have."""
    along = ranges.dry_level
    each = {k: getattr(along, k) * AT_TIP_MM for k in ("low", "high")}
    start = tuple(v * AT_TIP_MM for v in along.start)
    return replace(along, unit="N mm", start=start, **each)


def _apply_tip_rate(
    curve: SmoothCurve,
    rates: tuple[float, float],
    rig: RigParameters,
    damping: float,
    level: float,
    asymmetry: float,
    *c: float,
) -> RigParameters:
    law = Interface(
        viscous_n_mm_s_per_mm=damping,
        kinetic_n_mm_per_mm=level,
        asymmetry=asymmetry,
        rate_curve=curve.factors(c),
        rate_range_rad_s=rates,
    )
    return replace(rig, free=FreeLaw(at_tip=(law,)))


def _torque_over(variable: Variable, curve: SmoothCurve, ranges: LogRanges) -> Family:
    dry = dry_at_tip(ranges)
    neutral = (0.0,) * len(dry.start)
    own = (replace(p, start=neutral) for p in coordinates_of(curve))
    return Family(
        effect=Effect(
            name=f"tip torque over {variable}",
            title=f"drag and dry friction at the tip that change with {variable}",
            place=Place.NEEDLE,
            parameters=(_drag(ranges, len(dry.start)), dry, *own),
            apply=partial(_apply_torque, variable, curve),
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says=_SAYS.get(variable, variable),
        title=f"torque at the tip at {SLOW_RAD_S:g} rad/s",
        curve=partial(torques, curve),
        x_unit=UNITS[variable],
        unit="N mm",
    )


def torques(curve: SmoothCurve, damping: float, level: float, *c: float) -> Points:
    """Drag at a slow rate, and dry friction, times a curve, over its variable."""
    return curve.places, (damping * SLOW_RAD_S + level) * np.array(curve.factors(c))


def _apply_torque(
    variable: Variable,
    curve: SmoothCurve,
    rig: RigParameters,
    damping: float,
    level: float,
    *c: float,
) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, kinetic_n_mm_per_mm=level, varies=True)
    return replace(
        rig, free=FreeLaw(at_tip=(law,), curves=(curve.acting_on(ActsOn.TISSUE, variable, c),))
    )

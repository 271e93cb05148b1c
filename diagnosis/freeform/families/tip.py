"""Free laws of the tip, and of the angle of each piece of the shaft.

- at the tip: drag times a curve of the rate, and dry friction, which may differ between the directions
- at the tip: the same times a curve of the axial speed or the inserted length, as of a bevel that cuts,
  or of the angle, once a turn
- at the tip, or along the inserted shaft: a torque that depends on the angle, with one to four, or
  one and two waves per turn
- at the tip: a torque towards one angle that depends on the axial speed, as of a bevel that is pushed
- along the inserted shaft: damping that depends on the angle, as of a shaft that is not round
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import (
    SLOW_RAD_S,
    TURN_DEG,
    WAVES,
    curve_over,
    rates_of,
)
from diagnosis.freeform.family import Family, Points, coordinates, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, jumping_curve, periodic_curve, smooth_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import RATE_POINTS, Interface

AT_TIP, ALONG = (1, 2, 3, 4), (1, 2)  # waves in a turn
TORQUE_OVER = (Variable.AXIAL_SPEED, Variable.DEPTH)
_SAYS = {Variable.BASE_ANGLE: "tip_angle"}  # which follows that of the base, and is not known before
_SHOWN_DEG = np.linspace(-180.0, 180.0, 49)
_SHOWN_RAD_S = np.array([-1.0, -0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 1.0])
_MOST_UNEVEN = 0.95  # of the damping, that it changes over a turn
_AT_TIP_MM = 30.0  # of shaft, whose dry friction is as strong as one may start with at the tip


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that the tip may lack."""
    turned = Variable.BASE_ANGLE in ranges.ends
    angles: tuple[Family, ...] = ()
    if turned:
        angles = (_angle(ranges, tip=True), _angle(ranges, tip=False), _uneven_damping(ranges))
    if turned and Variable.AXIAL_SPEED in ranges.ends:
        angles += (_pushed(ranges),)
    curves = {v: curve_over(v, ranges) for v in TORQUE_OVER if v in ranges.ends}
    if turned:
        curves[Variable.BASE_ANGLE] = periodic_curve(TURN_DEG, WAVES)
    changing = (_torque_over(v, curve, ranges) for v, curve in curves.items())
    return (_tip_rate(ranges), *changing, *angles)


def _tip_rate(ranges: LogRanges) -> Family:
    dry, rates = _dry(ranges), rates_of(ranges)
    curve, drag = smooth_curve(0.0, 1.0, RATE_POINTS), _drag(ranges, len(dry.start))
    neutral = (0.0,) * len(dry.start)
    return Family(
        effect=Effect(
            name="tip torque over rate",
            title="drag and dry friction in one place, at the tip",
            place=Place.NEEDLE,
            parameters=(
                replace(drag, start=(drag.scale,) * len(dry.start)),  # of no drag a curve tells nothing
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
    places = np.log(np.geomspace(*rates, RATE_POINTS))
    at = np.interp(np.log(np.abs(_SHOWN_RAD_S)), places, curve.values(c))
    own = damping * np.exp(at) * _SHOWN_RAD_S + level * np.sign(_SHOWN_RAD_S)
    return _SHOWN_RAD_S, own * (1 + side * np.sign(_SHOWN_RAD_S))


def _drag(ranges: LogRanges, starts: int) -> Parameter:
    """Drag at the tip, which may be 0."""
    own = ranges.library["tip_drag"].parameters[0]
    return Parameter(
        name=own.name, unit=own.unit, low=0.0, high=own.high, start=(0.0,) * starts, scale=own.start[0]
    )


def _dry(ranges: LogRanges) -> Parameter:
    """Dry friction at the tip, in the range of what `_AT_TIP_MM` of shaft have."""
    along = ranges.library["coulomb_friction"].parameters[0]
    each = {k: getattr(along, k) * _AT_TIP_MM for k in ("low", "high")}
    start = tuple(v * _AT_TIP_MM for v in along.start)
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
    dry = _dry(ranges)
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
        curve=partial(_torques, curve),
        x_unit=UNITS[variable],
        unit="N mm",
    )


def _torques(curve: SmoothCurve, damping: float, level: float, *c: float) -> Points:
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


def _angle(ranges: LogRanges, *, tip: bool) -> Family:
    """A torque over the angle, with sine and cosine of each wave as coordinates."""
    size = _level(ranges) * (_AT_TIP_MM if tip else 1.0)
    where, waves = ("tip torque", AT_TIP) if tip else ("torque along the shaft", ALONG)

    return Family(
        effect=Effect(
            name=f"{where} over tip_angle",
            title=f"{where} that depends on its angle",
            place=Place.NEEDLE,
            parameters=coordinates(2 * len(waves), 0, size),
            apply=partial(_apply_angle, waves, tip),
        ),
        places={Place.NEEDLE: 1.0},
        says="tip_angle",
        title=where,
        curve=partial(_over_a_turn, waves),
        x_unit="deg",
        unit="N mm" if tip else "N mm / mm",
    )


def _level(ranges: LogRanges) -> float:
    """Of strong friction, N mm / mm."""
    return ranges.library["coulomb_friction"].parameters[0].start[-1]


def _pushed(ranges: LogRanges) -> Family:
    """A torque towards one angle, which is proportional to the axial speed to start with."""
    curve = jumping_curve(*ranges.ends[Variable.AXIAL_SPEED])
    proportional = curve.coordinates(curve.places / np.abs(curve.places).max())
    return Family(
        effect=Effect(
            name="tip torque over tip_angle and axial_speed",
            title="torque that turns the tip towards one angle while the needle slides",
            place=Place.NEEDLE,
            parameters=(
                *_amplitudes(ranges),
                *coordinates_of(curve),
            ),
            apply=partial(_apply_pushed, curve, proportional),
        ),
        places={Place.NEEDLE: 1.0},
        says=Variable.AXIAL_SPEED,
        title="torque that turns the tip towards one angle",
        curve=partial(_over_speed, curve, proportional),
        x_unit=UNITS[Variable.AXIAL_SPEED],
        unit="N mm",
    )


def _amplitudes(ranges: LogRanges) -> tuple[Parameter, ...]:
    """Of a sine and a cosine, N mm."""
    each = coordinates(2, 0, _level(ranges) * _AT_TIP_MM)
    return tuple(replace(p, name=f"{p.name} of the wave") for p in each)


def _over_speed(
    curve: SmoothCurve, proportional: Sequence[float], sine: float, cosine: float, *c: float
) -> Points:
    speeds = curve.values([a + b for a, b in zip(proportional, c, strict=True)])
    return curve.places, math.hypot(sine, cosine) * np.array(speeds)


def _apply_pushed(
    curve: SmoothCurve,
    proportional: Sequence[float],
    rig: RigParameters,
    sine: float,
    cosine: float,
    *c: float,
) -> RigParameters:
    law = _wave(1, sine, cosine).but(varies=True)
    whole = [a + b for a, b in zip(proportional, c, strict=True)]
    own = curve.acting_on(ActsOn.ORIENTATION, Variable.AXIAL_SPEED, whole)
    return replace(rig, free=FreeLaw(at_tip=(law,), curves=(own,)))


def _uneven_damping(ranges: LogRanges) -> Family:
    """Damping of each piece of the shaft over its own angle."""
    beta = ranges.damping_n_mm_s_per_mm
    return Family(
        effect=Effect(
            name="damping along the shaft over tip_angle",
            title="damping that depends on the angle of the shaft",
            place=Place.INTERFACE,
            parameters=coordinates(2 * len(ALONG), 0, beta),
            apply=partial(_apply_uneven, beta),
        ),
        places={Place.INTERFACE: 0.6, Place.NEEDLE: 0.4},
        says="tip_angle",
        title="damping along the shaft",
        curve=partial(_damping_over_a_turn, beta),
        x_unit="deg",
        unit="N mm s / rad / mm",
    )


def _damping_over_a_turn(beta: float, *c: float) -> Points:
    angle, waves = _over_a_turn(ALONG, *_kept_below(beta, c))
    return angle, beta + np.asarray(waves)


def _apply_uneven(beta: float, rig: RigParameters, *c: float) -> RigParameters:
    kept = _kept_below(beta, c)
    waves = zip(ALONG, kept[::2], kept[1::2], strict=True)
    return replace(rig, free=FreeLaw(throughout=tuple(_damping_wave(*own) for own in waves)))


def _damping_wave(cycles: int, sine: float, cosine: float) -> Interface:
    """One wave: a sin x + b cos x = hypot(a, b) cos(x - atan2(a, b))."""
    return Interface(
        orientation_viscous_n_mm_s_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=math.degrees(math.atan2(sine, cosine)),
        orientation_cycles=float(cycles),
    )


def _kept_below(beta: float, c: Sequence[float]) -> list[float]:
    """Waves that leave some damping at any angle."""
    most = sum(math.hypot(a, b) for a, b in zip(c[::2], c[1::2], strict=True))
    share = min(1.0, _MOST_UNEVEN * beta / most) if most > 0.0 else 1.0
    return [share * own for own in c]


def _over_a_turn(waves: Sequence[int], *c: float) -> Points:
    angle = np.radians(_SHOWN_DEG)
    each = zip(waves, c[::2], c[1::2], strict=True)
    waves = [a * np.sin(n * angle) + b * np.cos(n * angle) for n, a, b in each]
    return _SHOWN_DEG, np.sum(waves, axis=0)


def _apply_angle(waves: Sequence[int], tip: bool, rig: RigParameters, *c: float) -> RigParameters:
    laws = tuple(_wave(n, a, b) for n, a, b in zip(waves, c[::2], c[1::2], strict=True))
    free = FreeLaw(at_tip=laws) if tip else FreeLaw(throughout=laws)
    return replace(rig, free=free)


def _wave(cycles: int, sine: float, cosine: float) -> Interface:
    """The law of one wave: a sin x + b cos x = hypot(a, b) sin(x + atan2(b, a))."""
    return Interface(
        orientation_n_mm_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=-math.degrees(math.atan2(cosine, sine)),
        orientation_cycles=float(cycles),
    )

"""Free laws of the angle of each piece of the shaft.

- at the tip: a torque that depends on the angle, with one to four waves per turn
- along the inserted shaft: such a torque with one and two waves, or with two alone: a bent shaft prefers
  one angle in a turn, and a flat one two, as does tissue whose fibres run one way
- at the tip: a torque towards one angle that depends on the axial speed, as of a bevel that is pushed
- along the inserted shaft: damping, or dry friction, that depends on the angle, as of a shaft that is
  not round
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates, coordinates_of, most_probable
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, jumping_curve
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import UNITS, Variable
from models.tissue import Interface

Array = NDArray[np.float64]

AT_TIP, ALONG, OF_FIBRES = (1, 2, 3, 4), (1, 2), (2,)  # waves in a turn
_HALF_TURN_DEG, _SHOWN = 180.0, 49  # angles at which a law is shown
_EITHER = {Place.NEEDLE: 0.5, Place.TISSUE: 0.5}
_FLAT = {Place.NEEDLE: 0.55, Place.TISSUE: 0.45}
_MOST_UNEVEN = 0.95  # of the damping, that it changes over a turn


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that depend on the angle of the shaft; none if it hardly turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    found = [_angle(ranges, AT_TIP, {Place.NEEDLE: 1.0}, tip=True), _angle(ranges, ALONG, _EITHER)]
    found.append(_angle(ranges, OF_FIBRES, _FLAT, more=", twice a turn"))
    found += [_uneven_damping(ranges), _uneven_friction(ranges)]
    if Variable.AXIAL_SPEED in ranges.ends:
        found.append(_pushed(ranges))
    return tuple(found)


def _angle(
    ranges: LogRanges,
    waves: Sequence[int],
    places: Mapping[Place, float],
    *,
    tip: bool = False,
    more: str = "",
) -> Family:
    """A torque over the angle, with sine and cosine of each wave as coordinates."""
    size = _level(ranges) * (AT_TIP_MM if tip else 1.0)
    where = "tip torque" if tip else "torque along the shaft"
    return Family(
        effect=Effect(
            name=f"{where} over tip_angle{more}",
            title=f"{where} that depends on its angle{more}",
            place=most_probable(places),
            parameters=coordinates(2 * len(waves), 0, size),
            apply=partial(_apply_angle, waves, tip),
        ),
        places=places,
        says="tip_angle",
        title=where,
        curve=partial(over_angles, shown_deg(ranges), waves),
        x_unit="deg",
        unit="N mm" if tip else "N mm / mm",
    )


def _level(ranges: LogRanges) -> float:
    """Of strong friction, N mm / mm."""
    return ranges.dry_level.start[-1]


def _pushed(ranges: LogRanges) -> Family:
    """A torque towards one angle, which is proportional to the axial speed to start with."""
    curve = jumping_curve(*ranges.ends[Variable.AXIAL_SPEED])
    proportional = curve.coordinates(curve.places / np.abs(curve.places).max())
    return Family(
        effect=Effect(
            name="tip torque towards one angle over axial_speed",
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
    each = coordinates(2, 0, _level(ranges) * AT_TIP_MM)
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
        curve=partial(_damping_over_angles, shown_deg(ranges), beta),
        x_unit="deg",
        unit=VISCOUS,
    )


def _damping_over_angles(shown: Array, beta: float, *c: float) -> Points:
    angle, waves = over_angles(shown, ALONG, *_kept_below(beta, c))
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
    most = _sum_of_sizes(c)
    share = min(1.0, _MOST_UNEVEN * beta / most) if most > 0.0 else 1.0
    return [share * own for own in c]


def _uneven_friction(ranges: LogRanges) -> Family:
    """Dry friction of each piece of shaft over its own angle: never less than at its easiest angle."""
    return Family(
        effect=Effect(
            name="dry friction along the shaft over tip_angle",
            title="dry friction that depends on the angle of the shaft",
            place=Place.INTERFACE,
            parameters=_level_and_waves(ranges.dry_level),
            apply=_apply_uneven_friction,
            differences=(1e-2,),
        ),
        places={Place.INTERFACE: 0.6, Place.NEEDLE: 0.4},
        says="tip_angle",
        title="dry friction along the shaft",
        curve=partial(_friction_over_angles, shown_deg(ranges)),
        x_unit="deg",
        unit="N mm / mm",
    )


def _level_and_waves(level: Parameter) -> tuple[Parameter, ...]:
    """Starts in four directions: at no wave, its size has no slope."""
    towards = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)]
    starts = [(size, size * sine, size * cosine) for size in level.start for sine, cosine in towards]
    levels, sines, cosines = zip(*starts, strict=True)
    sine, cosine, *others = coordinates(2 * len(ALONG), 0, level.start[-1])
    return (
        replace(level, start=levels),
        replace(sine, start=sines),
        replace(cosine, start=cosines),
        *(replace(p, start=(0.0,) * len(starts)) for p in others),
    )


def _friction_over_angles(shown: Array, level: float, *c: float) -> Points:
    angle, waves = over_angles(shown, ALONG, *c)
    return angle, level + _sum_of_sizes(c) + np.asarray(waves)


def _sum_of_sizes(c: Sequence[float]) -> float:
    return sum(math.hypot(a, b) for a, b in zip(c[::2], c[1::2], strict=True))


def _apply_uneven_friction(rig: RigParameters, level: float, *c: float) -> RigParameters:
    waves = zip(ALONG, c[::2], c[1::2], strict=True)
    first, *others = (_friction_wave(*own) for own in waves)
    return replace(rig, free=FreeLaw(throughout=(first.but(kinetic_n_mm_per_mm=level), *others)))


def _friction_wave(cycles: int, sine: float, cosine: float) -> Interface:
    """One wave and its size: a sin x + b cos x + hypot(a, b), which is nowhere below 0."""
    return Interface(
        orientation_dry_n_mm_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=math.degrees(math.atan2(sine, cosine)),
        orientation_cycles=float(cycles),
    )


def over_angles(shown: Array, waves: Sequence[float], *c: float) -> Points:
    """The sum of waves with these cycles in a turn, sine and cosine of each, over angles, deg."""
    angle = np.radians(shown)
    each = zip(waves, c[::2], c[1::2], strict=True)
    return shown, np.sum([a * np.sin(n * angle) + b * np.cos(n * angle) for n, a, b in each], axis=0)


def shown_deg(ranges: LogRanges, shown: int = _SHOWN) -> Array:
    """So many angles of a turn that the base has been at: of others a log says nothing."""
    low, high = ranges.ends[Variable.BASE_ANGLE]
    if high - low >= 2.0 * _HALF_TURN_DEG:
        low, high = -_HALF_TURN_DEG, _HALF_TURN_DEG
    return np.linspace(low, high, shown)


def _apply_angle(waves: Sequence[int], tip: bool, rig: RigParameters, *c: float) -> RigParameters:
    laws = waves_over(waves, c)
    free = FreeLaw(at_tip=laws) if tip else FreeLaw(throughout=laws)
    return replace(rig, free=free)


def waves_over(waves: Sequence[float], c: Sequence[float]) -> tuple[Interface, ...]:
    """Laws of waves with these cycles in a turn, with sine and cosine of each."""
    return tuple(_wave(n, a, b) for n, a, b in zip(waves, c[::2], c[1::2], strict=True))


def _wave(cycles: float, sine: float, cosine: float) -> Interface:
    """The law of one wave: a sin x + b cos x = hypot(a, b) sin(x + atan2(b, a))."""
    return Interface(
        orientation_n_mm_per_mm=math.hypot(sine, cosine),
        orientation_phase_deg=-math.degrees(math.atan2(cosine, sine)),
        orientation_cycles=float(cycles),
    )

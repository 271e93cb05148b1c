"""Free laws of the angle of each piece of the shaft.

- at the tip: a torque that depends on the angle, with one to four waves per turn
- along the inserted shaft: such a torque with one and two waves, or with two alone: a bent shaft prefers
  one angle in a turn, and a flat one two, as does tissue whose fibres run one way
- at the tip: a torque towards one angle that depends on the axial speed, as of a bevel that is pushed
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.in_one_place.tip import AT_TIP_MM
from diagnosis.freeform.family import Family, Points, coordinates, coordinates_of, most_probable
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


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that depend on the angle of the shaft; none if it hardly turns."""
    if Variable.BASE_ANGLE not in ranges.ends:
        return ()
    found = [_angle(ranges, AT_TIP, {Place.NEEDLE: 1.0}, tip=True), _angle(ranges, ALONG, _EITHER)]
    found.append(_angle(ranges, OF_FIBRES, _FLAT, more=", twice a turn"))
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

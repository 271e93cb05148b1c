"""Free laws of the needle itself.

- the stiffness of the shaft as a curve of the torque that it carries, either way
- a shaft that twists plastically beyond a torque
- at the tip: drag and dry friction, which may differ between the directions
- at the tip, or along the inserted shaft: a torque that depends on the angle, with one to four, or
  one and two waves per turn
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.family import Family, Points, coordinates, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, two_sided_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.needle import STIFFNESS_POINTS
from models.tissue import Interface

AT_TIP, ALONG = (1, 2, 3, 4), (1, 2)  # waves in a turn
_SHOWN_DEG = np.linspace(-180.0, 180.0, 49)
_SHOWN_RAD_S = np.array([-1.0, -0.3, -0.1, -0.03, 0.03, 0.1, 0.3, 1.0])
_YIELDS_AT = (0.85, 0.55, 0.3)  # of the largest torque, to start with
_LEAST_YIELD, _YIELD_SLOPE = 0.02, 0.4
_BEYOND = 1.5  # torque that a curve spans / that of the nominal shaft: one that yields twists more
_AT_TIP_MM = 30.0  # of shaft, whose dry friction is as strong as one may start with at the tip


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that the needle may lack."""
    turned = Variable.BASE_ANGLE in ranges.ends
    angles = (_angle(ranges, tip=True), _angle(ranges, tip=False)) if turned else ()
    loaded = Variable.TORQUE in ranges.ends
    shaft = (_stiffness(ranges), _yielding(ranges)) if loaded else ()
    return (_tip_rate(ranges), *shaft, *angles)


def _tip_rate(ranges: LogRanges) -> Family:
    dry = _dry(ranges)

    return Family(
        effect=Effect(
            name="tip torque over rate",
            title="drag and dry friction in one place, at the tip",
            place=Place.NEEDLE,
            parameters=(
                _drag(ranges, len(dry.start)),
                dry,
                Parameter(
                    name="asymmetry", unit="-", low=-0.95, high=0.95, start=(0.0,) * len(dry.start)
                ),
            ),
            apply=_apply_tip_rate,
            differences=(1e-2,),
        ),
        places={Place.NEEDLE: 1.0},
        says="rate",
        title="torque at the tip",
        curve=_at_rates,
        x_unit="rad/s",
        unit="N mm",
    )


def _at_rates(damping: float, level: float, side: float) -> Points:
    own = damping * _SHOWN_RAD_S + level * np.sign(_SHOWN_RAD_S)
    return _SHOWN_RAD_S, own * (1 + side * np.sign(_SHOWN_RAD_S))


def _stiffness(ranges: LogRanges) -> Family:
    most_n_mm = _BEYOND * max(abs(end) for end in ranges.ends[Variable.TORQUE])
    curve = two_sided_curve(most_n_mm, STIFFNESS_POINTS)
    return Family(
        effect=Effect(
            name="stiffness over torque",
            title="a shaft whose stiffness changes with the torque that it carries",
            place=Place.NEEDLE,
            parameters=coordinates_of(curve),
            apply=partial(_apply_stiffness, curve, most_n_mm),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="stiffness of the shaft over the nominal",
        curve=partial(_factors, curve),
        x_unit="N mm",
        unit="-",
    )


def _factors(curve: SmoothCurve, *c: float) -> Points:
    return curve.places, curve.factors(c)


def _by_sign(factors: Sequence[float]) -> tuple[float, ...]:
    """Of negative torques from 0, then of positive ones; they come in the order of the torques."""
    negative, positive = factors[:STIFFNESS_POINTS], factors[STIFFNESS_POINTS:]
    return (*negative[::-1], *positive)


def _apply_stiffness(
    curve: SmoothCurve, most_n_mm: float, rig: RigParameters, *c: float
) -> RigParameters:
    law = FreeLaw(stiffness_over_torque=_by_sign(curve.factors(c)), stiffness_torque_n_mm=most_n_mm)
    return replace(rig, free=law)


def _yielding(ranges: LogRanges) -> Family:
    most_n_mm = max(abs(end) for end in ranges.ends[Variable.TORQUE])
    starts = tuple(share * most_n_mm for share in _YIELDS_AT)
    torque = Parameter(
        name="torque",
        unit="N mm",
        low=_LEAST_YIELD * most_n_mm,
        high=2.0 * most_n_mm,
        start=starts,
        logarithmic=True,
        neutral=None,
    )
    slope = Parameter(
        name="slope", unit="-", low=0.0, high=0.98, start=(_YIELD_SLOPE,) * len(starts), neutral=1.0
    )
    return Family(
        effect=Effect(
            name="plastic twist over torque",
            title="a shaft that twists plastically beyond a torque",
            place=Place.NEEDLE,
            parameters=(torque, slope),
            apply=_apply_yielding,
            differences=(1e-2, 1e-3),
        ),
        places={Place.NEEDLE: 1.0},
        says="torque",
        title="torque of the shaft over its twist",
        curve=_yields,
        x_unit="of the twist at which it yields",
        unit="N mm",
    )


def _yields(torque: float, slope: float) -> Points:
    twists = np.array([0.0, 1.0, 3.0])
    return twists, torque * np.array([0.0, 1.0, 1.0 + 2.0 * slope])


def _apply_yielding(rig: RigParameters, torque: float, slope: float) -> RigParameters:
    return replace(rig, free=FreeLaw(yield_torque_n_mm=torque, yield_stiffness_ratio=slope))


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


def _apply_tip_rate(rig: RigParameters, damping: float, level: float, asymmetry: float) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=damping, kinetic_n_mm_per_mm=level, asymmetry=asymmetry)
    return replace(rig, free=FreeLaw(at_tip=(law,)))


def _angle(ranges: LogRanges, *, tip: bool) -> Family:
    """A torque over the angle, with sine and cosine of each wave as coordinates."""
    level = ranges.library["coulomb_friction"].parameters[0].start[-1]
    size = level * _AT_TIP_MM if tip else level
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

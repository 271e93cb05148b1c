"""Free laws of the torque of a contact over its past.

- damping, or dry friction, times a curve of the slip so far: lubrication and wear
- damping times a curve of the heat of slipping, which fades: warmed tissue
- damping, or dry friction, times a curve of the share of its structure that slip has broken, which heals
  in time: thixotropic tissue, a gel
- damping, or dry friction, times a curve of the slip since it turned back: tissue that bites
- damping, or dry friction, times a curve of the share of fibres that lie along the slip, which lays them
- dry friction times a curve of the age of the contact, which slip renews; it starts as one that grows
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial

import numpy as np

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import FILM
from diagnosis.freeform.family import VISCOUS, Family, Points, coordinates_of
from diagnosis.freeform.ranges import LEAST_RANGE, LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.contact import CONTACT_POINTS, ContactCurve, ContactVariable
from models.tissue import Interface

_FIRST_PART = 30.0  # of the slip in a log: below it places are even
_FIRST_AGE_S = 0.1
_GROWS = 1.0  # slope of a curve over age to start with
_CHANGES = 0.5  # of one of the damping, either way
_PLACES = {Place.INTERFACE: 1.0}
_UNITS = {
    ContactVariable.SLIP: "deg",
    ContactVariable.AGE: "s",
    ContactVariable.HEAT: "(rad/s)^2 of late",
    ContactVariable.BROKEN: "of its structure broken",
    ContactVariable.TURNED: "deg since it turned back",
    ContactVariable.ALIGNED: "of the fibres along the slip",
}
_WORDS = {
    ContactVariable.SLIP: "the slip so far",
    ContactVariable.AGE: "the age of the contact",
    ContactVariable.HEAT: "how fast it has slipped of late",
    ContactVariable.BROKEN: "the share of its structure that slip has broken",
    ContactVariable.TURNED: "the slip since it turned back",
    ContactVariable.ALIGNED: "the share of fibres that lie along the slip",
}
_FADING = Parameter(
    name="fading", unit="s", low=0.1, high=60.0, start=(1.0, 5.0), logarithmic=True, neutral=None
)
_RENEWAL = Parameter(
    name="renewal", unit="deg", low=0.05, high=90.0, start=(3.0,), logarithmic=True, neutral=None
)
_BREAKING = Parameter(
    name="breaking",
    unit="deg",
    low=1.0,
    high=3600.0,
    start=(10.0, 10.0, 90.0, 90.0),
    logarithmic=True,
    neutral=None,
)
_HEALING = replace(_FADING, name="healing", start=(1.0, 10.0) * 2)
_LAYING = replace(_BREAKING, name="laying")
_SMOOTH = (-1.0, 1.0) * 2  # slope of a curve over the fibres along the slip to start with
_BITES = (-2.0, 2.0)  # slope of a curve over the slip since it turned back to start with
_TURNS_BACK_DEG = 0.3  # slip after which it counts as turned back
_WEAKENS = (-1.0,) * 4  # slope of a curve over what is broken to start with
_STARTING: dict[ContactVariable, tuple[tuple[Parameter, ...], tuple[float, ...]]] = {
    ContactVariable.HEAT: ((_FADING,), (_CHANGES, -_CHANGES)),
    ContactVariable.BROKEN: ((_BREAKING, _HEALING), _WEAKENS),
    ContactVariable.ALIGNED: ((_LAYING,), _SMOOTH),
    ContactVariable.TURNED: ((), _BITES),
}
"""What a contact remembers by, and slopes of the curve to start with."""
_REMEMBERS = {
    ContactVariable.AGE: ("renewal_deg",),
    ContactVariable.HEAT: ("fading_s",),
    ContactVariable.BROKEN: ("renewal_deg", "fading_s"),
    ContactVariable.ALIGNED: ("renewal_deg",),
}
"""Fields of its record that are fitted."""


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that depend on the past of a contact."""
    found: list[Family] = []
    if Variable.HISTORY in ranges.ends:
        found += [_damping_over(own, ranges) for own in (_slip(ranges), _heat(ranges), _broken_share())]
        found += [_friction_over(own, ranges) for own in (_slip(ranges), _broken_share())]
        found += [over(_aligned_share(), ranges) for over in (_damping_over, _friction_over)]
    if {Variable.HISTORY, Variable.BASE_ANGLE} <= ranges.ends.keys():
        found += [over(_turned(ranges), ranges) for over in (_damping_over, _friction_over)]
    if Variable.TIME in ranges.ends:
        found.append(_friction_over(_age(ranges), ranges))
    return tuple(found)


def _slip(ranges: LogRanges) -> ContactCurve:
    """A neutral curve over the slip that the turns of a log can make."""
    most_deg = 360.0 * ranges.ends[Variable.HISTORY][1]
    return _neutral(ContactVariable.SLIP, most_deg / _FIRST_PART, most_deg)


def _age(ranges: LogRanges) -> ContactCurve:
    """A neutral curve over the ages that contacts can reach in a log."""
    return _neutral(ContactVariable.AGE, _FIRST_AGE_S, ranges.ends[Variable.TIME][1])


def _heat(ranges: LogRanges) -> ContactCurve:
    """A neutral curve over the squares of the rates at which contacts slip in a log."""
    fastest = max(ranges.fastest_slip_rad_s, LEAST_RANGE[Variable.RATE])
    return _neutral(ContactVariable.HEAT, fastest**2 / _FIRST_PART, fastest**2)


def _turned(ranges: LogRanges) -> ContactCurve:
    """A neutral curve over the slip since it turned back that the motions of a log can make."""
    low, high = ranges.ends[Variable.BASE_ANGLE]
    neutral = _neutral(ContactVariable.TURNED, (high - low) / _FIRST_PART, high - low)
    turned: ContactCurve = neutral.but(renewal_deg=_TURNS_BACK_DEG)
    return turned


def _broken_share() -> ContactCurve:
    """A neutral curve over the share of its structure that slip has broken."""
    return _neutral(ContactVariable.BROKEN, 1.0, 1.0)


def _aligned_share() -> ContactCurve:
    """A neutral curve over the share of fibres that lie along the slip."""
    return _neutral(ContactVariable.ALIGNED, 1.0, 1.0)


def _neutral(over: ContactVariable, scale: float, last: float) -> ContactCurve:
    return ContactCurve(over=over, scale=scale, last=last, factors=(1.0,) * CONTACT_POINTS)


def _damping_over(neutral: ContactCurve, ranges: LogRanges) -> Family:
    curve = smooth_curve(0.0, 1.0, CONTACT_POINTS)
    shape = coordinates_of(curve)
    if neutral.over in _STARTING:
        shape = _starting(shape, *_STARTING[neutral.over])
    return Family(
        effect=Effect(
            name=f"damping over {neutral.over}",
            title=f"damping that changes with {_WORDS[neutral.over]}",
            place=Place.INTERFACE,
            parameters=shape,
            apply=partial(_apply_damping, curve, neutral),
        ),
        places=FILM,
        says="history",
        title="damping along the shaft",
        curve=partial(_damping, curve, neutral, ranges.damping_n_mm_s_per_mm),
        x_unit=_UNITS[neutral.over],
        unit=VISCOUS,
    )


def _starting(
    shape: tuple[Parameter, ...], memory: tuple[Parameter, ...], slopes: tuple[float, ...]
) -> tuple[Parameter, ...]:
    """What a contact remembers by, and the coordinates of a curve that start with these slopes."""
    level, change, *rest = (replace(p, start=len(slopes) * p.start) for p in shape)
    return (*memory, level, replace(change, start=slopes), *rest)


def _damping(curve: SmoothCurve, neutral: ContactCurve, beta: float, *shape: float) -> Points:
    return neutral.places, beta * np.array(_shaped(neutral, curve, shape).factors)


def _apply_damping(
    curve: SmoothCurve, neutral: ContactCurve, rig: RigParameters, *shape: float
) -> RigParameters:
    return replace(rig, free=FreeLaw(contact=_shaped(neutral, curve, shape)))


def _friction_over(neutral: ContactCurve, ranges: LogRanges) -> Family:
    curve = smooth_curve(0.0, 1.0, CONTACT_POINTS)
    level = ranges.dry_level
    shape = coordinates_of(curve)
    if neutral.over is ContactVariable.AGE:
        grows = replace(shape[1], start=(_GROWS,))
        shape = (_RENEWAL, shape[0], grows, *shape[2:])
    elif neutral.over in _STARTING:
        shape = _starting(shape, *_STARTING[neutral.over])
        level = replace(level, start=level.start[-1:])
    each = len(shape[0].start)
    level = replace(level, start=level.start * each) if each > 1 else level
    shape = shape if each > 1 else tuple(replace(p, start=p.start * len(level.start)) for p in shape)
    return Family(
        effect=Effect(
            name=f"dry friction over {neutral.over}",
            title=f"dry friction that changes with {_WORDS[neutral.over]}",
            place=Place.INTERFACE,
            parameters=(level, *shape),
            apply=partial(_apply_friction, curve, neutral),
            differences=(1e-2,),
        ),
        places=_PLACES,
        says="history",
        title="dry friction along the shaft",
        curve=partial(_levels, curve, neutral),
        x_unit=_UNITS[neutral.over],
        unit="N mm / mm",
    )


def _levels(curve: SmoothCurve, neutral: ContactCurve, level: float, *shape: float) -> Points:
    return neutral.places, level * np.array(_shaped(neutral, curve, shape).factors)


def _apply_friction(
    curve: SmoothCurve, neutral: ContactCurve, rig: RigParameters, level: float, *shape: float
) -> RigParameters:
    law = Interface(kinetic_n_mm_per_mm=level, contact=_shaped(neutral, curve, shape))
    return replace(rig, free=FreeLaw(throughout=(law,)))


def _shaped(neutral: ContactCurve, curve: SmoothCurve, shape: Sequence[float]) -> ContactCurve:
    """The curve with its coordinates; what renews or fades what it is over comes first."""
    fields = _REMEMBERS.get(neutral.over, ())
    memory = dict(zip(fields, shape, strict=False))
    changed: ContactCurve = neutral.but(factors=curve.factors(shape[len(fields) :]), **memory)
    return changed

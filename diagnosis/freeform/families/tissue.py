"""Free laws of the tissue: elastic (Kelvin-Voigt), with a stiffness that is a curve of a variable.

Its viscosity goes along with the stiffness by a power that is fitted. The stiffness may also be a curve
of the twist of the tissue: it hardens or softens; or of its largest twist so far: it softens for good.
"""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial

import numpy as np
from numpy.typing import NDArray

from diagnosis.effects.effect import Effect, Parameter, Place
from diagnosis.freeform.families.interface import FADING, PARTS
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.curve import ActsOn
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import SAYS, UNITS, Variable
from models.contact import CONTACT_POINTS, ContactCurve, ContactVariable, contact_places

Array = NDArray[np.float64]

OVER = (Variable.TIME, Variable.TRIAL_SHARE, Variable.DEPTH, Variable.HISTORY)
_FOLLOWS = Parameter(name="follows", unit="-", low=0.0, high=1.0, start=(0.5,) * 4, neutral=None)
_OF_TWIST = {
    ContactVariable.TWIST: ("with its twist", "torque", "deg"),
    ContactVariable.STRAINED: ("with its largest twist so far", "history", "deg of twist so far"),
}
_EVEN_DEG, _MOST_DEG = 3.0, 45.0  # twist below which places are even, and beyond which none is


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """Families of laws that the tissue may lack."""
    over = (_elastic_over(v, ranges) for v in OVER if v in ranges.ends)
    twisted = (
        (ContactVariable.TWIST, ContactVariable.STRAINED) if Variable.BASE_ANGLE in ranges.ends else ()
    )
    hardening = (_elastic_over_twist(over, ranges) for over in twisted)
    return (*over, _elastic_along_depth(ranges), *hardening)


def _elastic_over(variable: Variable, ranges: LogRanges) -> Family:
    curve = smooth_curve(*ranges.ends[variable], fading=variable in FADING)
    law, words = partial(_law_over, variable, curve), f"with {variable}"
    along = (_FOLLOWS,)
    return _elastic(ranges, curve, law, along, over=variable, words=words, unit=UNITS[variable])


def _elastic_along_depth(ranges: LogRanges) -> Family:
    curve = smooth_curve(0.0, 1.0, PARTS)
    law = partial(_law_along_depth, curve)
    unit = "of the inserted length"
    return _elastic(ranges, curve, law, over="position", words="along the inserted shaft", unit=unit)


def _elastic_over_twist(twist: ContactVariable, ranges: LogRanges) -> Family:
    """The tissue twists by at most half of what the base turns to and fro."""
    low_deg, high_deg = ranges.ends[Variable.BASE_ANGLE]
    most_deg = min(0.5 * (high_deg - low_deg), _MOST_DEG)
    curve = replace(smooth_curve(0.0, 1.0, CONTACT_POINTS), places=contact_places(_EVEN_DEG, most_deg))
    law, along = partial(_law_over_twist, twist, curve), (_FOLLOWS,)
    words, says, unit = _OF_TWIST[twist]
    return _elastic(ranges, curve, law, along, over=twist, words=words, unit=unit, says=says)


def _elastic(
    ranges: LogRanges,
    curve: SmoothCurve,
    law: Callable[[Sequence[float]], FreeLaw],
    more: Sequence[Parameter] = (),
    *,
    over: str,
    words: str,
    unit: str,
    says: str = "",
) -> Family:
    """Elastic tissue that changes as a curve; `law` makes the law from more and its coordinates."""
    elastic = ranges.library["tissue_viscoelasticity"].parameters
    neutral = (0.0,) * len(elastic[0].start)
    own = (replace(p, start=neutral) for p in coordinates_of(curve))
    return Family(
        effect=Effect(
            name=f"elastic tissue over {over}",
            title=f"elastic tissue that changes {words}",
            place=Place.TISSUE,
            parameters=(*elastic, *more, *own),
            apply=partial(_apply, law),
        ),
        places={Place.TISSUE: 1.0},
        says=says or SAYS.get(over, over),
        title="stiffness of the tissue",
        curve=partial(_stiffness, curve, len(more)),
        x_unit=unit,
        unit="N mm / rad / mm",
    )


def _law_over(variable: Variable, curve: SmoothCurve, c: Sequence[float]) -> FreeLaw:
    curves = (curve.acting_on(ActsOn.TISSUE, variable, c[1:]),)
    return FreeLaw(stiffness_varies=True, viscosity_exponent=c[0], curves=curves)


def _law_along_depth(curve: SmoothCurve, c: Sequence[float]) -> FreeLaw:
    return FreeLaw(along_depth=AlongDepth(stiffness=curve.factors(c)))


def _law_over_twist(twist: ContactVariable, curve: SmoothCurve, c: Sequence[float]) -> FreeLaw:
    contact = ContactCurve(
        over=twist,
        scale=_EVEN_DEG,
        last=float(curve.places[-1]),
        factors=curve.factors(c[1:]),
    )
    return FreeLaw(contact=contact, viscosity_exponent=c[0])


def _stiffness(curve: SmoothCurve, more: int, stiffness: float, _: float, *c: float) -> Points:
    return curve.places, stiffness * np.array(curve.factors(c[more:]))


def _apply(
    law: Callable[[Sequence[float]], FreeLaw],
    rig: RigParameters,
    stiffness: float,
    time_constant: float,
    *c: float,
) -> RigParameters:
    return replace(
        rig,
        tissue_stiffness_n_mm_per_rad_per_mm=stiffness,
        tissue_time_constant_s=time_constant,
        free=law(c),
    )

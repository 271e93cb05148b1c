"""A free law of the tip: drag that changes with how far it has turned, as of fibres that wind up.

    torque = drag factor(turned so far, either way) rate of the tip

The tip turns less than the base, by what the shaft winds up, so a curve over the turns of the base is
another law.
"""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np

from diagnosis.effects.effect import Effect, Place
from diagnosis.freeform.families.interface import SLOW_RAD_S
from diagnosis.freeform.family import Family, Points, coordinates_of
from diagnosis.freeform.ranges import LogRanges
from diagnosis.freeform.smooth_curve import SmoothCurve, smooth_curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable
from models.contact import CONTACT_POINTS, ContactCurve, ContactVariable, contact_places
from models.tissue import Interface

_FIRST_PART = 20.0  # of the farthest turn: places are even below that, and close
_SLOPES = (0.0, -2.0)  # to start with: drag that stays, or falls to 2 %


def families(ranges: LogRanges) -> tuple[Family, ...]:
    """The law, if the base turns."""
    if Variable.HISTORY not in ranges.ends:
        return ()
    most_deg = 360.0 * ranges.ends[Variable.HISTORY][1]
    curve = smooth_curve(0.0, 1.0, CONTACT_POINTS)
    drag = ranges.library["tip_drag"].parameters[0]
    starts, slopes = zip(*product(drag.start, _SLOPES), strict=True)
    level, slope, *rest = coordinates_of(curve)
    none = (0.0,) * len(starts)
    own = (replace(p, start=slopes if p is slope else none) for p in (level, slope, *rest))
    return (
        Family(
            effect=Effect(
                name="tip torque over slip",
                title="drag at the tip that changes with how far it has turned",
                place=Place.NEEDLE,
                parameters=(replace(drag, start=starts, neutral=None), *own),
                apply=partial(_apply, curve, most_deg),
            ),
            places={Place.NEEDLE: 1.0},
            says="history",
            title=f"torque at the tip at {SLOW_RAD_S:g} rad/s",
            curve=partial(_torques, curve, most_deg),
            x_unit="deg turned so far",
            unit="N mm",
        ),
    )


def _torques(curve: SmoothCurve, most_deg: float, drag: float, *c: float) -> Points:
    places = contact_places(most_deg / _FIRST_PART, most_deg)
    return places, drag * SLOW_RAD_S * np.array(curve.factors(c))


def _apply(
    curve: SmoothCurve, most_deg: float, rig: RigParameters, drag: float, *c: float
) -> RigParameters:
    law = Interface(viscous_n_mm_s_per_mm=drag, contact=_over_slip(most_deg, curve.factors(c)))
    return replace(rig, free=FreeLaw(at_tip=(law,)))


def _over_slip(most_deg: float, factors: Sequence[float]) -> ContactCurve:
    return ContactCurve(
        over=ContactVariable.SLIP,
        scale=most_deg / _FIRST_PART,
        last=most_deg,
        factors=tuple(factors),
    )

"""A law that depends on what a contact between shaft and tissue has been through.

Its torque is multiplied by a curve over one of

    slip    angle by which the shaft has slipped there so far, in both directions, deg
    age     time since the contact was renewed, s: d age / dt = 1 - age |slip rate| / renewal
    heat    of slipping of late, (rad/s)^2: d heat / dt = (slip rate^2 - heat) / fading
    broken  share of its structure that slip has broken:
            d broken / dt = (1 - broken) |slip rate| / renewal - broken / fading
    turned_by
            angle by which the shaft has slipped there since it turned back, deg: it grows with the slip
            one way; the other way it is forgotten within a slip of `renewal`, and grows again
    aligned share of the fibres that lie along the present direction of slip, which lays them:
            (1 + n sign(torque)) / 2,    dn / dt = (sign(slip rate) - n) |slip rate| / renewal

(age: Dieterich's law of ageing, J. Geophys. Res. 84 (1979); broken: Moore's law of thixotropy, Trans.
Brit. Ceramic Soc. 58 (1959)), or the stiffness of yielding tissue by one over

    twist   angle by which the tissue is twisted there, either way, deg: tissue that hardens or softens
    strained
            the largest twist so far, deg: tissue that softens for good (Mullins, Rubber Chemistry and
            Technology 42 (1969))

The curve is given at places that are
close near 0, scale (exp(u) - 1) with even u, and level beyond the last one.
"""

from enum import StrEnum

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from models.needle import Positive
from models.record import Record

Array = NDArray[np.float64]

CONTACT_POINTS = 9


class ContactVariable(StrEnum):
    """What a contact remembers."""

    SLIP = "slip"
    AGE = "age"
    HEAT = "heat"
    BROKEN = "broken"
    TURNED = "turned_by"
    ALIGNED = "aligned"
    TWIST = "twist"
    STRAINED = "strained"


class ContactCurve(Record):
    """Factors on the torque of a contact, or on the stiffness of its tissue."""

    over: ContactVariable
    factors: tuple[Positive, ...] = Field(min_length=CONTACT_POINTS, max_length=CONTACT_POINTS)
    scale: Positive
    """Below which places are even, deg, s, (rad/s)^2 or a share."""
    last: Positive
    """Place of the last factor, in the same unit."""
    renewal_deg: Positive = 1.0
    """Slip that renews a contact, breaks its structure or lays its fibres by a factor e, or after which
    it has turned back: of age, broken, aligned and turned_by alone."""
    fading_s: Positive = 1.0
    """In which heat fades, or structure heals, by a factor e: of heat and broken alone."""
    first_broken: float = Field(default=0.0, ge=0, le=1)
    """Share of its structure that is broken where shaft and tissue first touch: of broken alone."""

    @property
    def places(self) -> Array:
        """Places of the factors, in the unit of the scale, (CONTACT_POINTS,)."""
        return contact_places(self.scale, self.last)


def contact_places(scale: float, last: float) -> Array:
    """Places of a curve, from 0 to the last, in the unit of both, (CONTACT_POINTS,)."""
    return scale * np.expm1(np.linspace(0.0, np.log1p(last / scale), CONTACT_POINTS))

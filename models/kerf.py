"""A kerf: a bevelled tip lies in the slit that it has cut, and cuts another only as the needle moves on.

    torque = most tanh(phi / angle),    dphi/dt = rate of the tip - (v / travel) phi

or, of a bent tip in a curved tract, in which it may lie the other way round,

    torque = most sin(phi),             dphi/dt = rate of the tip - (v / travel) sin(phi)

phi is the angle of the tip from its kerf. On the way back v counts in part, or not at all.
"""

from pydantic import Field

from models.needle import Positive
from models.record import Record


class Kerf(Record):
    """What holds a bevelled or bent tip in the slit that it has cut."""

    torque_n_mm: Positive
    """At most."""
    angle_deg: Positive | None = None
    """Beyond which the torque hardly grows; None: it is a sine."""
    travel_mm: Positive
    """In which the kerf follows the tip: a small angle between them fades by a factor e."""
    backwards: float = Field(default=1.0, ge=0, le=1)
    """Part of the way back that counts; 0: there the tip finds the kerf that it has cut."""

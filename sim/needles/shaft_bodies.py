"""The shaft cut at nodes: each body is the shaft half way to the neighbours of its node.

    mass = rho A a,   inertia about the axis = rho J a,   across it = mass (3 r^2 + a^2) / 12

with a the length of the body (a solid cylinder). The rotor of the drive turns with the first body,
what the needle carries at its tip with the last.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from models import units
from models.errors import InvalidValue
from models.needle import Needle

Array = NDArray[np.float64]

_LEAST_INERTIA = 1e-15  # kg m^2, below which MuJoCo refuses a body


@dataclass(frozen=True, kw_only=True)
class ShaftBodies:
    """The bodies of the shaft from base to tip, m of them.

    Attributes:
      node_m: position of the node from the base, (m,).
      back_m, ahead_m: how far the body reaches from its node, (m,) each.
      mass_kg: (m,).
      inertia_kg_m2: about x (the axis), y and z, (m, 3).
      radius_m: of all.
    """

    node_m: Array
    back_m: Array
    ahead_m: Array
    mass_kg: Array
    inertia_kg_m2: Array
    radius_m: float

    @property
    def centre_m(self) -> Array:
        """Centre of the body from its node, (m,)."""
        centre: Array = 0.5 * (self.ahead_m - self.back_m)
        return centre

    @property
    def half_length_m(self) -> Array:
        """Half the length of the body, (m,)."""
        half: Array = 0.5 * (self.ahead_m + self.back_m)
        return half

    def from_parent_m(self, *, chain: bool) -> Array:
        """Position of the node in its parent's frame, (m,): of the node before, or of the carriage."""
        return np.diff(self.node_m, prepend=0.0) if chain else self.node_m


def shaft_bodies(needle: Needle, nodes_mm: Array, *, rotor_inertia_kg_m2: float) -> ShaftBodies:
    """Cut the shaft at nodes, (m,), mm from the base.

    Raises:
      InvalidValue: a body is too small for MuJoCo's floor on inertia.
    """
    node, radius = nodes_mm * units.MM, needle.radius_mm * units.MM
    half = 0.5 * np.diff(node)
    back, ahead = np.concatenate([[0.0], half]), np.concatenate([half, [0.0]])
    length = back + ahead
    about = needle.rotary_inertia_kg_m * length
    if about.min() < _LEAST_INERTIA:
        raise InvalidValue(
            "elements",
            node.size - 1,
            f"elements whose inertia is at least {_LEAST_INERTIA} kg m^2, not {about.min():.1e}",
            "take fewer elements, or a thicker needle",
        )
    about[0] += rotor_inertia_kg_m2
    about[-1] += needle.tip_inertia_kg_m2
    mass = needle.mass_kg_per_m * length
    across = np.maximum(mass * (3 * radius**2 + length**2) / 12, about)
    return ShaftBodies(
        node_m=node,
        back_m=back,
        ahead_m=ahead,
        mass_kg=mass,
        inertia_kg_m2=np.stack([about, across, across], axis=1),
        radius_m=radius,
    )

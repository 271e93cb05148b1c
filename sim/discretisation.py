"""Discretisation of needle and time, and the arrangement of the bodies in MuJoCo."""

from enum import StrEnum
from functools import lru_cache
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field, model_validator

from models.errors import InvalidValue
from models.record import Record
from models.tissue import Tissue

Array = NDArray[np.float64]

LONGEST_STEP_S = 0.1


class Arrangement(StrEnum):
    """The parent body of an element in MuJoCo. Both arrangements give the same angles."""

    CHAIN = "chain"
    """Each element turns on its neighbour: joint springs are the torsion."""
    SIBLINGS = "siblings"
    """Every element turns on the carriage: diagonal inertia, cheaper beyond n = 16. MuJoCo has
    no joint between neighbours then; the callback adds the springs that the model lists."""


class Mesh(StrEnum):
    """Frame in which the nodes are fixed. Recordings hold these values."""

    LAGRANGIAN = "needle"
    """Nodes are material points of the shaft: they move with the needle, and tissue covers ever
    more of them as it goes in."""
    EULERIAN = "tissue"
    """Nodes are places in the tissue, whose inserted length is constant: the shaft slides past
    them, and the elements of the free shaft stretch. Where the needle does not slide, the two
    coincide."""
    FED = "fed"
    """Nodes are places between the chuck, the tissue and the deepest point of the tip: the shaft comes
    out of a chuck that stands still, and slides past them. Elements beyond the tip are rigid."""


class SlipRate(StrEnum):
    """Which rate of the angle theta(x, t) the tissue resists while a twisted shaft slides at v.

    Protocols write these values: `slip: material` or `slip: place`.
    """

    MATERIAL_DERIVATIVE = "material"
    """d theta/dt + v d theta/dx: the rate of a material point of the shaft, which friction feels."""
    SPATIAL_DERIVATIVE = "place"
    """d theta/dt at a fixed place in the tissue, as in the paper's equation (9)."""


PRESLIDING_DEG = 0.1
"""Angle at which a dry element slips, of a rig of which nothing else is known."""


class Discretisation(Record):
    """Elements, step and arrangement.

    With the defaults, the tip is within 0.002 deg of the closed form in a fast turn of a
    needle 20 cm deep (measured in docs/simulation.md).
    """

    elements: Annotated[int, Field(ge=2, le=1000)] = 16
    """Along the inserted shaft (Eulerian mesh) or the whole needle (other meshes)."""
    free_elements: Annotated[int, Field(ge=1, le=1000)] | None = None
    """Along the free shaft (Eulerian mesh); None: 1, or 8 where a sheath rubs."""
    step_s: Annotated[float, Field(gt=0, le=LONGEST_STEP_S)] = 0.01
    presliding_deg: Annotated[float, Field(gt=0, le=5)] = PRESLIDING_DEG
    """Angle at which a dry element slips."""
    order: Annotated[int, Field(ge=1, le=3)] = 2
    """Of the step: 2, or 3 where a larger step is to be as accurate, or 1 for MuJoCo's own step, to
    which only the tissue's torque is added."""
    arrangement: Arrangement = Arrangement.CHAIN
    slip: SlipRate = SlipRate.MATERIAL_DERIVATIVE

    @model_validator(mode="after")
    def _springs_are_mujocos_own(self) -> "Discretisation":
        if self.order == 1 and self.arrangement is not Arrangement.CHAIN:
            raise InvalidValue(
                "discretisation.arrangement",
                self.arrangement.value,
                "'chain' for a step of order 1, because siblings have no joint springs between them",
                "take arrangement: chain, or order: 2",
            )
        return self


def node_positions_mm(
    discretisation: Discretisation,
    mesh: Mesh,
    tissue: Tissue,
    *,
    free_mm: float,
    inserted_mm: float,
    sheath: bool,
) -> tuple[Array, int]:
    """Positions of the nodes from the chuck, mm, (n + 1,), read-only, and how many elements share the
    free length.

    An Eulerian mesh has nodes at the entry and at every boundary between layers, and even spacing in
    between.

    Raises:
      InvalidValue: the mesh is Eulerian and the needle has not entered the tissue.
    """
    if mesh is not Mesh.EULERIAN:
        return _nodes_mm(0.0, 0, (0.0, free_mm + inserted_mm), discretisation.elements), 0
    if inserted_mm <= 0:
        raise InvalidValue(
            "inserted_mm", inserted_mm, "a depth above 0 mm, because the mesh is fixed to the tissue"
        )
    boundaries = tuple(tissue.boundaries_mm(inserted_mm).tolist())
    outside = 0 if free_mm == 0 else discretisation.free_elements or (8 if sheath else 1)
    return _nodes_mm(free_mm, outside, boundaries, discretisation.elements), outside


@lru_cache(maxsize=256)  # a fit simulates the same trials again and again
def _nodes_mm(free_mm: float, outside: int, boundaries: tuple[float, ...], elements: int) -> Array:
    """Node positions: of `outside` elements that share the free length, then between boundaries."""
    inside = free_mm + _even_between(boundaries, elements)
    nodes = np.concatenate([np.linspace(0.0, free_mm, outside + 1)[:-1], inside])
    nodes.setflags(write=False)
    return nodes


def _even_between(boundaries: tuple[float, ...], elements: int) -> Array:
    """Node positions: `elements` distributed over the stretches by length, at least two each."""
    lengths = np.diff(boundaries)
    shares = np.maximum(2, np.round(elements * lengths / lengths.sum()).astype(int))
    shares[np.argmax(lengths)] = max(2, elements - (shares.sum() - shares.max()))
    pieces = [
        np.linspace(start, end, count + 1)[1:]
        for start, end, count in zip(boundaries[:-1], boundaries[1:], shares, strict=True)
    ]
    return np.concatenate([boundaries[:1], *pieces])

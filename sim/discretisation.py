"""How finely needle and time are cut, and how the same bodies are arranged."""

from enum import StrEnum
from typing import Annotated

import numpy as np
from numpy.typing import NDArray
from pydantic import Field

from models.errors import InvalidValue
from models.record import Record
from models.tissue import Tissue

Array = NDArray[np.float64]


class Arrangement(StrEnum):
    """Whose child an element is. Both land on the same angles."""

    CHAIN = "chain"
    """Each element turns on its neighbour: joint springs are the torsion."""
    SIBLINGS = "siblings"
    """Every element turns on the carriage: diagonal inertia, cheaper beyond n = 16."""


class Mesh(StrEnum):
    """What the nodes are fixed to."""

    NEEDLE = "needle"
    """The needle: tissue covers ever more of it as it goes in."""
    TISSUE = "tissue"
    """The tissue, whose depth is constant: the shaft slides past the nodes."""


class Slip(StrEnum):
    """Whose rate the tissue resists while the shaft slides axially, twisted."""

    MATERIAL = "material"
    """Of the material of the shaft: what friction feels."""
    PLACE = "place"
    """At a fixed place in the tissue: d theta / dt of equation (9)."""


class Discretisation(Record):
    """Elements, step and arrangement.

    The defaults keep the tip within 0.002 deg of the closed form on a fast turn of a
    needle 20 cm deep (docs/simulation.md has the measurements).
    """

    elements: Annotated[int, Field(ge=2, le=1000)] = 16
    """Along the inserted shaft (mesh `tissue`) or the whole needle (mesh `needle`)."""
    free_elements: Annotated[int, Field(ge=1, le=1000)] | None = None
    """Along the free shaft (mesh `tissue`); None: 1, or 8 where a sheath rubs."""
    step_s: Annotated[float, Field(gt=0, le=0.1)] = 0.01
    presliding_deg: Annotated[float, Field(gt=0, le=5)] = 0.1
    """Angle at which a dry element slips."""
    arrangement: Arrangement = Arrangement.CHAIN
    slip: Slip = Slip.MATERIAL


def node_positions_mm(
    discretisation: Discretisation,
    mesh: Mesh,
    tissue: Tissue,
    *,
    free_mm: float,
    inserted_mm: float,
    sheath: bool,
) -> tuple[Array, int]:
    """Positions of the nodes from the chuck, mm, and how many elements share the free length.

    A mesh that stands in the tissue has nodes at the entry and at every boundary of
    layers, and is even in between.

    Raises:
      InvalidValue: the mesh is to stand in tissue that the needle has not entered.
    """
    total = free_mm + inserted_mm
    if mesh is Mesh.NEEDLE:
        return np.linspace(0.0, total, discretisation.elements + 1), 0
    if inserted_mm <= 0:
        raise InvalidValue("inserted_mm", inserted_mm, "a depth above 0 for a mesh fixed to tissue")
    inside = free_mm + _even_between(tissue.boundaries_mm(inserted_mm), discretisation.elements)
    if free_mm == 0:
        return inside, 0
    outside = discretisation.free_elements or (8 if sheath else 1)
    return np.concatenate([np.linspace(0.0, free_mm, outside + 1)[:-1], inside]), outside


def _even_between(boundaries: Array, elements: int) -> Array:
    """`elements` elements shared out to the stretches by length, at least two each."""
    lengths = np.diff(boundaries)
    shares = np.maximum(2, np.round(elements * lengths / lengths.sum()).astype(int))
    shares[np.argmax(lengths)] = max(2, elements - (shares.sum() - shares.max()))
    pieces = [
        np.linspace(start, end, count + 1)[1:]
        for start, end, count in zip(boundaries[:-1], boundaries[1:], shares, strict=True)
    ]
    return np.concatenate([boundaries[:1], *pieces])

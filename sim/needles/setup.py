"""A set-up: the rig and its discretisation, from which everything in a MuJoCo model follows."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.needle import Needle
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh, node_positions_mm
from sim.law_table import law_table
from sim.needles.shaft_bodies import ShaftBodies, shaft_bodies

Array = NDArray[np.float64]

# A rigid servo is this much stiffer than the needle: its error is 1e-6 of the lag.
_RIGID = 1e6


@dataclass(frozen=True, kw_only=True)
class Setup:
    """Everything that a model depends on: the rig and its discretisation.

    Attributes:
      needle, tissue, drive: the rig.
      discretisation: elements and step.
      mesh: frame in which the nodes are fixed.
      free_mm, inserted_mm: lengths at the start; together the shaft that is modelled.
      rows: least number of rows of the law table.
      slip_share: weight of the material (1) against the spatial (0) derivative in the slip
        rate, where it is a blend of both; None: as the discretisation says.
    """

    needle: Needle
    tissue: Tissue
    drive: Drive = Drive()  # noqa: RUF009 - frozen
    discretisation: Discretisation = Discretisation()  # noqa: RUF009 - frozen
    mesh: Mesh = Mesh.EULERIAN
    free_mm: float
    inserted_mm: float
    rows: int = 0
    slip_share: float | None = None

    def __post_init__(self) -> None:
        for name in ("free_mm", "inserted_mm"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise InvalidValue(name, value, "a finite length of at least 0 mm")
        total = self.free_mm + self.inserted_mm
        if total <= 0:
            raise InvalidValue(
                "inserted_mm", self.inserted_mm, "a length for which free_mm + inserted_mm is above 0"
            )

    @property
    def nodes_mm(self) -> Array:
        """Node positions from the chuck at the start, mm, (n + 1,)."""
        return self._mesh[0]

    @cached_property
    def law(self) -> Array:
        """The law table, (rows, columns) of `sim.kernel.memory_map`."""
        return law_table(self.needle, self.drive, self.tissue, rows=self.rows)

    @property
    def size(self) -> tuple[object, ...]:
        """Key of the model's structure: models of set-ups with the same key differ only in numbers."""
        limited = self.drive.torque_limit_n_mm is not None
        return self.is_chain, self.drive.kind, limited, self.nodes_mm.size, len(self.law)

    @property
    def is_chain(self) -> bool:
        """Whether bodies hinge on one another, with torsion in their joints."""
        return self.discretisation.arrangement is Arrangement.CHAIN

    def has_bodies_of(self, other: "Setup") -> bool:
        """Whether the bodies are those of another set-up of the same `size`."""
        same_ends = (self.needle.tip_inertia_kg_m2, self.drive.rotor_inertia_kg_m2) == (
            other.needle.tip_inertia_kg_m2,
            other.drive.rotor_inertia_kg_m2,
        )
        return (
            same_ends
            and self.needle.diameter_mm == other.needle.diameter_mm
            and self.needle.density_g_cm3 == other.needle.density_g_cm3
            and bool(np.array_equal(self.nodes_mm, other.nodes_mm))
        )

    @cached_property
    def bodies(self) -> ShaftBodies:
        """The bodies of the shaft. Raises `InvalidValue` if one is too light for MuJoCo."""
        rotor = self.drive.rotor_inertia_kg_m2
        return shaft_bodies(self.needle, self.nodes_mm, rotor_inertia_kg_m2=rotor)

    @property
    def stretching(self) -> int:
        """Elements that share the free length."""
        return self._mesh[1]

    @cached_property
    def _mesh(self) -> tuple[Array, int]:
        return node_positions_mm(
            self.discretisation,
            self.mesh,
            self.tissue,
            free_mm=self.free_mm,
            inserted_mm=self.inserted_mm,
            sheath=self.drive.rubs_in_sheath,
        )

    @cached_property
    def servo_n_m_per_rad(self) -> float:
        """Stiffness between drive shaft and needle, N m / rad; 0 if the drive gives torque."""
        if self.drive.kind is DriveKind.TORQUE:
            return 0.0
        if self.drive.stiffness_n_mm_per_rad is not None:
            return self.drive.stiffness_n_mm_per_rad * units.N_MM
        shaft = (self.free_mm + self.inserted_mm) * units.MM
        return _RIGID * self.needle.rigidity_n_mm2 * units.N_MM2 / shaft

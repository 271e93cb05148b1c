"""What acts on the shaft in the reference simulation: laws, drive and meshes.

Dry friction is elastic-plastic: the presliding angle z follows the slip until |z| reaches z_y, and
the torque is level z / z_y. Where the level is shared with the axial motion, z is a vector (turning
angle, axial travel / radius), and it is returned radially to a disc of radius z_y.

Viscous torque per mm is beta w |w|^(p-1). Two layers have dampings whose mean over the inserted
length is nominal.

Meshes are cell-centred finite volumes, with massless nodes for what is lumped in one place. One is
fixed in the tissue, the other to the needle: there each cell is in the tissue with the fraction of it
that lies beyond the entry. `NEUTRAL` names all effects and holds the parameters that switch them off.
Units inside: N, mm, s, rad.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]

NEUTRAL: dict[str, dict[str, float]] = {
    "coulomb_friction": {"level": 0.0},
    "stiction": {"kinetic": 0.0, "static": 0.0, "stribeck": 1.0},
    "speed_dependent_friction": {"level": 0.0},
    "shear_thinning": {"exponent": 1.0},
    "tissue_viscoelasticity": {"stiffness": math.inf, "time_constant": 0.0},
    "layered_tissue": {"ratio": 1.0, "boundary": 0.5},
    "entry_friction": {"level": 0.0},
    "sheath_friction": {"level": 0.0},
    "load_dependent_friction": {"coefficient": 0.0},
    "chuck_backlash": {"gap": 0.0},
    "base_compliance": {"stiffness": math.inf},
    "tip_drag": {"damping": 0.0},
    "needle_curvature": {"torque": 0.0, "phase": 0.0},
    "stiffness_error": {"scale": 1.0},
    "damping_error": {"scale": 1.0},
    "tip_angle_bias": {"bias": 0.0},
    "tip_angle_scale": {"scale": 1.0},
    "tip_sensor_delay": {"delay": 0.0},
    "torque_bias": {"bias": 0.0},
}
SMALLEST_FREE_MM = 1e-5
SMALLEST_RATE_RAD_S = 1e-6


@dataclass(frozen=True, kw_only=True)
class Rig:
    diameter_mm: float
    shear_modulus_gpa: float
    damping_n_mm_s_per_mm: float
    effects: dict[str, dict[str, float]] = field(default_factory=dict)
    presliding_deg: float = 0.1

    def __post_init__(self) -> None:
        for effect, parameters in self.effects.items():
            if set(parameters) != set(NEUTRAL.get(effect, ())):
                raise ValueError(f"unknown effect or wrong parameters: {effect} {sorted(parameters)}")

    def value(self, effect: str, parameter: str) -> float:
        return self.effects.get(effect, NEUTRAL[effect])[parameter]

    @property
    def radius_mm(self) -> float:
        return self.diameter_mm / 2

    @property
    def presliding_rad(self) -> float:
        return math.radians(self.presliding_deg)

    @property
    def rigidity_n_mm2(self) -> float:
        nominal = math.pi * self.diameter_mm**4 / 32 * self.shear_modulus_gpa * 1e3
        return nominal * self.value("stiffness_error", "scale")

    def mean_damping(self, shallow_share: Array) -> Array:
        """Viscous torque per rad/s and per mm where that share of the shaft is in the shallow layer."""
        ratio, boundary = self.value("layered_tissue", "ratio"), self.value("layered_tissue", "boundary")
        shallow = self.damping_n_mm_s_per_mm * self.value("damping_error", "scale")
        shallow /= boundary + ratio * (1 - boundary)
        return shallow * (shallow_share + ratio * (1 - shallow_share))


@dataclass(frozen=True, kw_only=True)
class Drive:
    """What acts from outside, linear between the samples."""

    time_s: Array
    angle_rad: Array | None
    torque_n_mm: Array | None
    inserted_mm: Array
    free_mm: Array
    speed_mm_s: Array
    tip_torque_n_mm: Array

    def at(self, time_s: float, channel: Array | None) -> float:
        assert channel is not None
        return float(np.interp(time_s, self.time_s, channel))


@dataclass(frozen=True, kw_only=True)
class Layout:
    """The chain of nodes at one moment; the last node is the tip.

    Friction at the entry acts on the nodes with the shares `entry`, where the entry is at the end of the
    step; the travel of what passes has the shares `passing`, where the entry is in its middle.
    """

    chuck_link: float
    links: Array
    depth_mm: Array
    tissue_mm: Array
    sheath_mm: Array
    damping: Array
    entry: Array
    passing: Array
    convection_mm_s: Array


@dataclass(frozen=True, kw_only=True)
class TissueMesh:
    """Mesh fixed in the tissue: free cells (if they carry friction), entry, inserted cells, tip."""

    rig: Rig
    drive: Drive
    inserted_mm: float
    cells: int
    free_cells: int
    material_slip: bool

    @property
    def nodes(self) -> int:
        return self.free_cells + 1 + self.cells + 1

    @property
    def reported(self) -> slice:
        return slice(self.free_cells + 1, self.free_cells + 1 + self.cells)

    @property
    def cell_mm(self) -> float:
        return self.inserted_mm / self.cells

    @property
    def place_mm(self) -> float:
        return self.cell_mm

    @property
    def places_mm(self) -> Array:
        return np.asarray((np.arange(self.cells) + 0.5) * self.cell_mm)

    def positions_mm(self, time_s: float) -> Array:
        return self.places_mm

    def layout(self, time_s: float, step_s: float) -> Layout:
        free_mm = max(self.drive.at(time_s, self.drive.free_mm), SMALLEST_FREE_MM)
        chuck_link, free_links = self.free_shaft(free_mm)
        inserted_links = chain(self.rig.rigidity_n_mm2, self.cell_mm, self.cells)
        depth_mm = self.spread(0.0, 0.0, self.places_mm, self.inserted_mm)
        boundary_mm = self.rig.value("layered_tissue", "boundary") * self.inserted_mm
        shallow = np.clip((boundary_mm - depth_mm) / self.cell_mm + 0.5, 0, 1)
        return Layout(
            chuck_link=chuck_link,
            links=np.concatenate((free_links, inserted_links)),
            depth_mm=depth_mm,
            tissue_mm=self.spread(0.0, 0.0, self.cell_mm, 0.0),
            sheath_mm=self.spread(free_mm / max(self.free_cells, 1), 0.0, 0.0, 0.0),
            damping=self.rig.mean_damping(shallow),
            entry=self.spread(0.0, 1.0, 0.0, 0.0),
            passing=self.spread(0.0, 1.0, 0.0, 0.0),
            convection_mm_s=self.convection(time_s, step_s),
        )

    def free_shaft(self, free_mm: float) -> tuple[float, Array]:
        if self.free_cells == 0:
            return self.rig.rigidity_n_mm2 / free_mm, np.zeros(0)
        links = chain(self.rig.rigidity_n_mm2, free_mm / self.free_cells, self.free_cells)
        return float(links[0]), links[1:]

    def convection(self, time_s: float, step_s: float) -> Array:
        """Speed of the shaft through the mesh; free cells stretch with the free length."""
        if not self.material_slip:
            return np.zeros(self.nodes)
        speed = self.drive.at(time_s, self.drive.speed_mm_s)
        earlier_mm = self.drive.at(time_s - step_s, self.drive.free_mm)
        free_rate = (self.drive.at(time_s, self.drive.free_mm) - earlier_mm) / step_s
        share_from_chuck = (np.arange(self.free_cells) + 0.5) / max(self.free_cells, 1)
        return self.spread(-share_from_chuck * free_rate, speed, speed, 0.0)

    def spread(self, free: ArrayLike, entry: float, inserted: ArrayLike, tip: float) -> Array:
        values = np.empty(self.nodes)
        values[: self.free_cells], values[self.free_cells] = free, entry
        values[self.reported], values[-1] = inserted, tip
        return values


@dataclass(frozen=True, kw_only=True)
class NeedleMesh:
    """Mesh fixed to the needle: cells from the chuck to the tip, and the tip."""

    rig: Rig
    drive: Drive
    total_mm: float
    cells: int

    @property
    def nodes(self) -> int:
        return self.cells + 1

    @property
    def reported(self) -> slice:
        return slice(0, self.cells)

    @property
    def cell_mm(self) -> float:
        return self.total_mm / self.cells

    @property
    def place_mm(self) -> float:
        """Fine enough that the centre of the last cell never lies beside bare tissue."""
        return self.cell_mm / 4

    @property
    def places_mm(self) -> Array:
        places = math.ceil(self.drive.inserted_mm.max() / self.place_mm)
        return np.asarray((np.arange(places) + 0.5) * self.place_mm)

    def positions_mm(self, time_s: float) -> Array:
        free_mm = self.total_mm - self.drive.at(time_s, self.drive.inserted_mm)
        return np.asarray((np.arange(self.cells) + 0.5) * self.cell_mm - free_mm)

    def layout(self, time_s: float, step_s: float) -> Layout:
        positions_mm, cell_mm = self.positions_mm(time_s), self.cell_mm
        inserted_mm = self.drive.at(time_s, self.drive.inserted_mm)
        tissue_mm = np.clip(positions_mm + cell_mm / 2, 0, cell_mm)
        depth_mm = positions_mm + (cell_mm - tissue_mm) / 2
        boundary_mm = self.rig.value("layered_tissue", "boundary") * inserted_mm
        covered_mm = np.maximum(tissue_mm, 1e-9 * cell_mm)
        shallow = np.clip((boundary_mm - depth_mm) / covered_mm + 0.5, 0, 1)
        links = chain(self.rig.rigidity_n_mm2, cell_mm, self.cells)
        return Layout(
            chuck_link=float(links[-1]),
            links=links[1:],
            depth_mm=np.append(depth_mm, inserted_mm),
            tissue_mm=np.append(tissue_mm, 0.0),
            sheath_mm=np.append(cell_mm - tissue_mm, 0.0),
            damping=np.append(self.rig.mean_damping(shallow), 0.0),
            entry=self.entry_shares(time_s),
            passing=self.entry_shares(time_s - step_s / 2),
            convection_mm_s=np.zeros(self.nodes),
        )

    def entry_shares(self, time_s: float) -> Array:
        """Shares of the two cells beside the entry."""
        free_mm = self.total_mm - self.drive.at(time_s, self.drive.inserted_mm)
        entry_cell = float(np.clip(free_mm / self.cell_mm - 0.5, 0, self.cells - 1))
        return np.asarray(np.maximum(1 - np.abs(np.arange(self.nodes) - entry_cell), 0.0))


Mesh = TissueMesh | NeedleMesh


def chain(rigidity: float, cell_mm: float, cells: int) -> Array:
    """Stiffness between one end, the centres of the cells, and the other end."""
    links = np.full(cells + 1, rigidity / cell_mm)
    links[[0, -1]] *= 2
    return links


def viscous(rig: Rig, damping: Array, rate: Array) -> tuple[Array, Array]:
    """Torque and its slope; the power law is linear below the smallest rate."""
    exponent = rig.value("shear_thinning", "exponent")
    size = rate**2 + SMALLEST_RATE_RAD_S**2
    torque = damping * rate * size ** ((exponent - 1) / 2)
    slope = damping * (exponent * rate**2 + SMALLEST_RATE_RAD_S**2) * size ** ((exponent - 3) / 2)
    return torque, slope


def dry_level(rig: Rig, rate: Array) -> tuple[Array, Array]:
    """Level of the dry friction that turning alone feels, and its slope with the slip rate."""
    kinetic, static = rig.value("stiction", "kinetic"), rig.value("stiction", "static")
    relative = rate / rig.value("stiction", "stribeck")
    excess = (static - kinetic) * np.exp(-(relative**2))
    level = rig.value("coulomb_friction", "level") + kinetic + excess
    return level, -2 * relative / rig.value("stiction", "stribeck") * excess


def preslide(limit: float, before: ArrayLike, travel: ArrayLike) -> tuple[Array, Array]:
    """Presliding after the travel, and its slope with the travel."""
    trial = np.asarray(before) + travel
    return np.clip(trial, -limit, limit), (np.abs(trial) < limit).astype(float)


def preslide_shared(limit: float, turning: Array, axial: Array) -> tuple[Array, Array, Array]:
    """Both components returned radially to the disc, and the slope of the first with its travel."""
    size = np.hypot(turning, axial)
    outside = size > limit
    size = np.where(outside, size, limit)
    slope = np.where(outside, limit * axial**2 / size**3, 1.0)
    return turning * limit / size, axial * limit / size, slope

"""Reference simulation of a long, flexible needle that is twisted in tissue.

The shaft turns by theta(x, t) between the chuck and the tip. Its inertia is negligible, so that at
every moment

    kappa theta'' = friction per mm,        kappa = J G,  J = pi d^4 / 32,

with the drive at the chuck (a prescribed angle or torque) and, at the tip, kappa theta' = -(torques
at the tip). Along the inserted shaft act viscous and dry friction, and the preference of a bent shaft
for one orientation. Along the free shaft acts the dry friction of a sheath. Entry, tip and chuck
carry lumped elements.

The interface sees the slip rate w = omega - phi_dot; its torque per mm twists the tissue, k phi + k
tau phi_dot. The twist phi belongs to places in the tissue. What is lumped does not pass through it.

At constant inserted length the mesh is fixed in the tissue, and omega is d theta/dt at a place
(slip="place") or d theta/dt + v d theta/dx (slip="material"); lumped elements at the tip always see d
theta/dt. If the inserted length changes, the mesh is fixed to the needle from chuck to tip, omega is
that of the material, and phi is kept on a grid that is fixed in the tissue.

Time: BDF2 with variable steps (the first step is backward Euler), each step solved by a semismooth
Newton method. Presliding follows the increment of the angle itself, which makes the return mapping
exact for a slip that does not turn back within a step. A trial starts untwisted and at rest, in the
middle of the chuck's play.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike
from reference_balance import State, Step, chuck
from reference_laws import Array, Drive, Mesh, NeedleMesh, Rig, TissueMesh
from reference_newton import solved

__all__ = ["Result", "Rig", "simulate"]

CONSTANT_LENGTH_MM = 1e-6
TOTAL_LENGTH_TOLERANCE_MM = 1e-2
DEEPEST_SPLIT = 8


@dataclass(frozen=True, kw_only=True)
class Result:
    """A row per sample, a column per cell; positions are depths, negative on the free shaft."""

    time_s: Array
    tip_angle_deg: Array
    base_torque_n_mm: Array
    base_angle_deg: Array
    angles_deg: Array
    positions_mm: Array
    tissue_deg: Array


class Simulation:
    """Marches from sample to sample; steps that do not converge are split."""

    def __init__(self, rig: Rig, drive: Drive, mesh: Mesh, dt: float):
        self.rig, self.drive, self.mesh, self.dt = rig, drive, mesh, dt
        start = 0.0 if drive.angle_rad is None else float(drive.angle_rad[0])
        rest = np.zeros(mesh.nodes)
        self.before: State | None = None
        self.now = State(
            time_s=float(drive.time_s[0]),
            angle=rest + start,
            twist=np.zeros_like(mesh.places_mm),
            presliding=rest,
            shared_turning=rest,
            shared_axial=rest,
            sheath=rest,
        )
        self.tip_history: list[tuple[float, float]] = []

    def run(self) -> Result:
        rows = [self.sample()]
        for end_s in self.drive.time_s[1:]:
            start_s = self.now.time_s
            steps = max(math.ceil((end_s - start_s) / self.dt - 1e-6), 1)
            for time_s in np.linspace(start_s, end_s, steps + 1)[1:]:
                self.advance(float(time_s))
            rows.append(self.sample())
        columns = (np.array(column) for column in zip(*rows, strict=True))
        torque, base, angles, positions, tissue = columns
        return Result(
            time_s=self.drive.time_s,
            tip_angle_deg=self.seen_tip_deg(),
            base_torque_n_mm=torque + self.rig.value("torque_bias", "bias"),
            base_angle_deg=np.degrees(base),
            angles_deg=np.degrees(angles),
            positions_mm=positions,
            tissue_deg=np.degrees(tissue),
        )

    def advance(self, time_s: float, split: int = 0) -> None:
        state = solved(Step(self.rig, self.drive, self.mesh, self.now, self.before, time_s))
        if state is None and split == DEEPEST_SPLIT:
            raise RuntimeError(f"no balance of torques found at {time_s} s")
        if state is None:
            self.advance((self.now.time_s + time_s) / 2, split + 1)
            self.advance(time_s, split + 1)
            return
        self.tip_history.append((self.now.time_s, self.now.angle[-1]))
        self.before, self.now = self.now, state

    def sample(self) -> tuple[float, float, Array, Array, Array]:
        time_s, angle, cells = self.now.time_s, self.now.angle, self.mesh.reported
        layout = self.mesh.layout(time_s, self.dt)
        torque, _ = chuck(self.rig, self.drive, layout, time_s, angle[0])
        twist = np.interp(layout.depth_mm, self.mesh.places_mm, self.now.twist)
        base = angle[0] + torque / layout.chuck_link
        return torque, base, angle[cells], self.mesh.positions_mm(time_s), twist[cells]

    def seen_tip_deg(self) -> Array:
        history = np.array([*self.tip_history, (self.now.time_s, self.now.angle[-1])])
        seen_s = self.drive.time_s - self.rig.value("tip_sensor_delay", "delay")
        tip_deg = np.degrees(np.interp(seen_s, history[:, 0], history[:, 1]))
        scaled_deg = self.rig.value("tip_angle_scale", "scale") * tip_deg
        return np.asarray(scaled_deg + self.rig.value("tip_angle_bias", "bias"))


def simulate(
    rig: Rig,
    *,
    time_s: ArrayLike,
    base_angle_deg: ArrayLike | None = None,
    base_torque_n_mm: ArrayLike | None = None,
    inserted_mm: ArrayLike,
    free_mm: ArrayLike,
    speed_mm_s: ArrayLike,
    tip_torque_n_mm: ArrayLike | None = None,
    cells: int = 200,
    dt: float = 1e-3,
    slip: str = "place",
) -> Result:
    """Replay one trial, driven by the angle of the drive shaft or by its torque."""
    if (base_angle_deg is None) == (base_torque_n_mm is None):
        raise ValueError("prescribe either the angle or the torque of the drive")
    if slip not in ("place", "material"):
        raise ValueError(f"slip is 'place' or 'material', not {slip!r}")
    time = np.asarray(time_s, dtype=float)
    drive = Drive(
        time_s=time,
        angle_rad=None if base_angle_deg is None else np.radians(on_samples(base_angle_deg, time)),
        torque_n_mm=None if base_torque_n_mm is None else on_samples(base_torque_n_mm, time),
        inserted_mm=on_samples(inserted_mm, time),
        free_mm=on_samples(free_mm, time),
        speed_mm_s=on_samples(speed_mm_s, time),
        tip_torque_n_mm=on_samples(0.0 if tip_torque_n_mm is None else tip_torque_n_mm, time),
    )
    return Simulation(rig, drive, mesh_for(rig, drive, cells, slip), dt).run()


def on_samples(values: ArrayLike, time_s: Array) -> Array:
    return np.broadcast_to(np.asarray(values, dtype=float), time_s.shape)


def mesh_for(rig: Rig, drive: Drive, cells: int, slip: str) -> Mesh:
    """Fixed in the tissue at constant inserted length, otherwise fixed to the needle."""
    if np.ptp(drive.inserted_mm) > CONSTANT_LENGTH_MM:
        return needle_mesh(rig, drive, cells, slip)
    inserted_mm = float(drive.inserted_mm[0])
    free_share = float(drive.free_mm.max()) / inserted_mm
    has_sheath = rig.value("sheath_friction", "level") > 0
    return TissueMesh(
        rig=rig,
        drive=drive,
        inserted_mm=inserted_mm,
        cells=cells,
        free_cells=max(math.ceil(cells * free_share), 1) if has_sheath else 0,
        material_slip=slip == "material",
    )


def needle_mesh(rig: Rig, drive: Drive, cells: int, slip: str) -> NeedleMesh:
    total_mm = drive.inserted_mm + drive.free_mm
    if slip != "material":
        raise ValueError("a changing inserted length needs slip='material'")
    if np.ptp(total_mm) > TOTAL_LENGTH_TOLERANCE_MM:
        raise ValueError("inserted and free length must add up to the same needle at all times")
    return NeedleMesh(rig=rig, drive=drive, total_mm=float(total_mm.mean()), cells=cells)

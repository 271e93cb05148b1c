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
from reference_laws import (
    Array,
    Drive,
    Layout,
    Mesh,
    NeedleMesh,
    Rig,
    TissueMesh,
    dry_level,
    preslide,
    preslide_shared,
    viscous,
)
from scipy.linalg import solve_banded

__all__ = ["Result", "Rig", "simulate"]

NEWTON_TOLERANCE_RAD = 1e-10
CONSTANT_LENGTH_MM = 1e-6
TOTAL_LENGTH_TOLERANCE_MM = 1e-2
LARGEST_STEP_RATIO = 2.0 + 1e-9
DEEPEST_SPLIT = 8
DESCENTS = 20


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


@dataclass(frozen=True, kw_only=True)
class State:
    """Angles and presliding of nodes, twist of places in the tissue, presliding of lumped elements."""

    time_s: float
    angle: Array
    twist: Array
    presliding: Array
    shared_turning: Array
    shared_axial: Array
    sheath: Array
    entry: float = 0.0
    tip: float = 0.0


@dataclass(frozen=True, kw_only=True)
class Linear:
    """A Newton step: rows (lower, own, upper) times turn = force, and the twist that follows from it."""

    rows: Array
    force: Array
    twist_rows: Array
    twist_force: Array

    def solve(self) -> tuple[Array, Array]:
        banded = np.zeros_like(self.rows)
        banded[0, 1:], banded[1], banded[2, :-1] = self.rows[2, :-1], self.rows[1], self.rows[0, 1:]
        turn = solve_banded((1, 1), banded, self.force, check_finite=False)
        twist = self.twist_force + self.twist_rows[1] * turn
        twist[1:] += self.twist_rows[0, 1:] * turn[:-1]
        twist[:-1] += self.twist_rows[2, :-1] * turn[1:]
        return turn, twist

    def mismatch(self) -> float:
        return float(np.linalg.norm(self.force) + np.linalg.norm(self.twist_force))


def difference(step_s: float, now: State, before: State | None) -> tuple[float, float, float]:
    """Weights of the new, last and older value in the rate: BDF2, or else backward Euler."""
    ratio = step_s / (now.time_s - before.time_s) if before is not None else math.inf
    if ratio > LARGEST_STEP_RATIO:
        return 1 / step_s, 1 / step_s, 0.0
    return (1 + 2 * ratio) / (1 + ratio) / step_s, (1 + ratio) / step_s, ratio**2 / (1 + ratio) / step_s


def chuck(
    rig: Rig, drive: Drive, layout: Layout, time_s: float, first_angle: float
) -> tuple[float, float]:
    """Torque that the drive puts into the needle, and the stiffness that the first node feels."""
    if drive.angle_rad is None:
        return drive.at(time_s, drive.torque_n_mm), 0.0
    half_gap = math.radians(rig.value("chuck_backlash", "gap")) / 2
    stiffness = 1 / (1 / layout.chuck_link + 1 / rig.value("base_compliance", "stiffness"))
    stretch = drive.at(time_s, drive.angle_rad) - first_angle
    torque = stiffness * (stretch - min(max(stretch, -half_gap), half_gap))
    return torque, stiffness if abs(stretch) >= half_gap else 0.0


class Step:
    """The balance of torques at the end of one step in time."""

    def __init__(
        self, rig: Rig, drive: Drive, mesh: Mesh, now: State, before: State | None, time_s: float
    ):
        self.rig, self.drive, self.mesh, self.now, self.time_s = rig, drive, mesh, now, time_s
        self.step_s = time_s - now.time_s
        self.layout = mesh.layout(time_s, self.step_s)
        self.limit = rig.presliding_rad
        self.steepest_fall = math.inf
        self.tip_torque = drive.at(time_s, drive.tip_torque_n_mm)
        self.axial_travel = self.mean_speed() * self.step_s / rig.radius_mm
        self.remember(before)
        self.soften()
        rate = 0.0 if before is None else (now.angle - before.angle) / (now.time_s - before.time_s)
        self.guess = (now.angle + self.step_s * rate, self.twist_now * (self.layout.tissue_mm > 0))

    def remember(self, before: State | None) -> None:
        """Rates at the end of the step are lead * value + past."""
        self.lead, last, older = difference(self.step_s, self.now, before)
        past = self.now if before is None else before
        self.angle_past = older * past.angle - last * self.now.angle
        self.place_past = older * past.twist - last * self.now.twist
        self.twist_past = self.at_nodes(self.place_past)
        self.twist_now = self.at_nodes(self.now.twist)

    def soften(self) -> None:
        """The twist at the end of the step is softness * torque - memory * past."""
        retardation_s = self.rig.value("tissue_viscoelasticity", "time_constant")
        slowing = 1 + retardation_s * self.lead
        self.tissue_softness = 1 / self.rig.value("tissue_viscoelasticity", "stiffness") / slowing
        self.tissue_memory = retardation_s / slowing

    def mean_speed(self) -> float:
        speed = self.drive.speed_mm_s
        return (self.drive.at(self.now.time_s, speed) + self.drive.at(self.time_s, speed)) / 2

    def at_nodes(self, places: Array) -> Array:
        return np.asarray(np.interp(self.layout.depth_mm, self.mesh.places_mm, places))

    def shaft(self, angle: Array) -> tuple[Array, Array]:
        """Torques and stiffnesses of the chuck, of all links, and of the free end."""
        torque, stiffness = chuck(self.rig, self.drive, self.layout, self.time_s, angle[0])
        inner = self.layout.links * (angle[:-1] - angle[1:])
        stiffnesses = np.concatenate(([stiffness], self.layout.links, [0.0]))
        return np.concatenate(([torque], inner, [0.0])), stiffnesses

    def turning(
        self, angle: Array, torques: Array, stiffness: Array
    ) -> tuple[Array, Array, Array, Array]:
        """Rate and travel of the shaft against the places, each with its rows."""
        rigidity = self.rig.rigidity_n_mm2
        flow = self.layout.convection_mm_s
        slope = -(torques[:-1] + torques[1:]) / (2 * rigidity)
        left, right = stiffness[:-1], stiffness[1:]
        flow_rows = flow * np.array((-left, left - right, right)) / (2 * rigidity)
        own = np.array(((0.0,), (1.0,), (0.0,)))
        rate = self.lead * angle + self.angle_past + flow * slope
        travel = angle - self.now.angle + self.step_s * flow * slope
        return rate, self.lead * own + flow_rows, travel, own + self.step_s * flow_rows

    def interface(self, rate: Array, travel: Array) -> tuple[Array, Array, Array]:
        """Torque per mm at that slip, and its slopes with rate and travel."""
        torque, per_rate = viscous(self.rig, self.layout.damping, rate)
        level, level_per_rate = dry_level(self.rig, rate)
        presliding, gain = preslide(self.limit, self.now.presliding, travel)
        shared, _, shared_gain = self.preslide_shared(travel)
        shared_level = self.rig.value("speed_dependent_friction", "level")
        torque = torque + (level * presliding + shared_level * shared) / self.limit
        per_rate = per_rate + np.maximum(level_per_rate * presliding / self.limit, -self.steepest_fall)
        return torque, per_rate, (level * gain + shared_level * shared_gain) / self.limit

    def preslide_shared(self, travel: Array) -> tuple[Array, Array, Array]:
        turning = self.now.shared_turning + travel
        return preslide_shared(self.limit, turning, self.now.shared_axial + self.axial_travel)

    def slip(self, rate: Array, travel: Array, twist: Array) -> tuple[Array, Array]:
        return rate - self.lead * twist - self.twist_past, travel - (twist - self.twist_now)

    def linearised(self, angle: Array, twist: Array) -> Linear:
        torques, stiffness = self.shaft(angle)
        rate, rate_rows, travel, travel_rows = self.turning(angle, torques, stiffness)
        torque, per_rate, per_travel = self.interface(*self.slip(rate, travel, twist))
        covered = self.layout.tissue_mm > 0
        softness, memory = covered * self.tissue_softness, covered * self.tissue_memory
        per_twist = self.lead * per_rate + per_travel
        relief = 1 / (1 + softness * per_twist)
        interface_rows = (per_rate * rate_rows + per_travel * travel_rows) * relief
        twist_force = (softness * torque - memory * self.twist_past - twist) * relief
        other_torque, other_rows = self.lumped_and_dry(angle, rate, travel, travel_rows)
        force = torques[:-1] - torques[1:] - self.layout.tissue_mm * (torque - per_twist * twist_force)
        shaft_rows = np.array((-stiffness[:-1], stiffness[:-1] + stiffness[1:], -stiffness[1:]))
        return Linear(
            rows=shaft_rows + self.layout.tissue_mm * interface_rows + other_rows,
            force=force - other_torque,
            twist_rows=softness * interface_rows,
            twist_force=twist_force,
        )

    def lumped_and_dry(
        self, angle: Array, rate: Array, travel: Array, travel_rows: Array
    ) -> tuple[Array, Array]:
        """Torques that do not pass through the interface: sheath, orientation, entry, tip."""
        sheath, gain = preslide(self.limit, self.now.sheath, travel)
        sheath_level = self.layout.sheath_mm * self.rig.value("sheath_friction", "level") / self.limit
        torque, rows = sheath_level * sheath, sheath_level * gain * travel_rows
        bend = self.layout.tissue_mm * self.rig.value("needle_curvature", "torque")
        lean = angle - math.radians(self.rig.value("needle_curvature", "phase"))
        torque = torque + bend * np.sin(lean)
        rows[1] += bend * np.cos(lean)
        self.add_entry(torque, rows, travel, travel_rows)
        self.add_tip(torque, rows, rate, travel)
        return torque, rows

    def add_entry(self, torque: Array, rows: Array, travel: Array, travel_rows: Array) -> None:
        """Rows leave out the rare and small coupling of nodes that are not neighbours."""
        passing = self.layout.passing
        level = self.rig.value("entry_friction", "level") / self.limit
        presliding, gain = preslide(self.limit, self.now.entry, passing @ travel)
        torque += level * float(presliding) * self.layout.entry
        stiffness = level * float(gain) * self.layout.entry
        rows += stiffness * passing * travel_rows
        rows[0, 1:] += stiffness[1:] * passing[:-1]
        rows[2, :-1] += stiffness[:-1] * passing[1:]

    def add_tip(self, torque: Array, rows: Array, rate: Array, travel: Array) -> None:
        drag = self.rig.value("tip_drag", "damping")
        coefficient = self.rig.value("load_dependent_friction", "coefficient")
        level = coefficient * abs(self.tip_torque) / self.limit
        presliding, gain = preslide(self.limit, self.now.tip, travel[-1])
        torque[-1] += self.tip_torque + drag * rate[-1] + level * float(presliding)
        rows[1, -1] += drag * self.lead + level * float(gain)

    def solved(self) -> State | None:
        """The state at the end of the step: by full Newton steps, else by damped ones, else by descent.

        Friction that falls faster with the slip rate than viscous torque rises has several balances.
        Without its falling slope, the steps descend to a stable one.
        """
        for most_halvings, most_iterations in ((0, 20), (6, 40)):
            found, angle, twist = self.iterated(*self.guess, most_halvings, most_iterations)
            if found:
                return self.finished(angle, twist)
        angle, twist = self.guess
        for _ in range(DESCENTS):
            _, angle, twist = self.iterated(angle, twist, 0, 40, steepest_fall=0.0)
            found, near_angle, near_twist = self.iterated(angle, twist, 0, 15)
            if found:
                return self.finished(near_angle, near_twist)
        return None

    def iterated(
        self, angle: Array, twist: Array, halvings: int, iterations: int, steepest_fall: float = math.inf
    ) -> tuple[bool, Array, Array]:
        """Newton steps from there, and whether they have come to rest."""
        self.steepest_fall = steepest_fall
        for _ in range(iterations):
            linear = self.linearised(angle, twist)
            turn, more_twist = linear.solve()
            part = self.helpful_part(angle, twist, turn, more_twist, linear.mismatch(), halvings)
            angle, twist = angle + part * turn, twist + part * more_twist
            change = max(np.abs(turn).max(), np.abs(more_twist).max())
            if change < NEWTON_TOLERANCE_RAD or not np.isfinite(change):
                return bool(np.isfinite(change)), angle, twist
        return False, angle, twist

    def helpful_part(
        self, angle: Array, twist: Array, turn: Array, more_twist: Array, mismatch: float, halvings: int
    ) -> float:
        """The part of a Newton step that lessens the mismatch."""
        part = 1.0
        for _ in range(halvings):
            if self.linearised(angle + part * turn, twist + part * more_twist).mismatch() < mismatch:
                break
            part /= 2
        return part

    def finished(self, angle: Array, twist: Array) -> State:
        rate, _, travel, _ = self.turning(angle, *self.shaft(angle))
        slip_rate, slip_travel = self.slip(rate, travel, twist)
        torque, _, _ = self.interface(slip_rate, slip_travel)
        touched, bare = self.layout.tissue_mm > 0, self.layout.sheath_mm > 0
        turning, axial, _ = self.preslide_shared(slip_travel)
        return State(
            time_s=self.time_s,
            angle=angle,
            twist=self.twist_of_places(torque),
            presliding=touched * preslide(self.limit, self.now.presliding, slip_travel)[0],
            shared_turning=touched * turning,
            shared_axial=touched * axial,
            sheath=bare * preslide(self.limit, self.now.sheath, travel)[0],
            entry=float(preslide(self.limit, self.now.entry, self.layout.passing @ travel)[0]),
            tip=float(preslide(self.limit, self.now.tip, travel[-1])[0]),
        )

    def twist_of_places(self, torque: Array) -> Array:
        """Each place feels the torque of the shaft that is there now; bare tissue creeps back."""
        touched, places_mm = self.layout.tissue_mm > 0, self.mesh.places_mm
        there = np.interp(places_mm, self.layout.depth_mm[touched], torque[touched])
        share = np.clip((self.layout.depth_mm[-1] - places_mm) / self.mesh.place_mm + 0.5, 0, 1)
        return np.asarray(self.tissue_softness * share * there - self.tissue_memory * self.place_past)


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
        state = Step(self.rig, self.drive, self.mesh, self.now, self.before, time_s).solved()
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

"""The balance of torques at the end of one step in time of the reference simulation, linearised."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from reference_laws import (
    Array,
    Drive,
    Layout,
    Mesh,
    Rig,
    dry_level,
    preslide,
    preslide_shared,
    viscous,
)
from scipy.linalg import solve_banded

LARGEST_STEP_RATIO = 2.0 + 1e-9


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

"""The needle as a MuJoCo model: a chain of capsules that hinge on one another.

A carriage slides along x and carries the base. The shaft is cut at nodes; each
node is a body with the mass and inertia of the shaft half way to its neighbours,
drawn as a capsule, and turns about x. Torsion between nodes a apart is the joint
stiffness kappa / a. The servo of the base is a joint spring with a motor of the
same gear, and so is the carriage's: both work in any viewer, without a callback.
Inertia, stiffness, servos and time step are defined only in the model: the callback
reads them from there.

The inputs (`ctrl`) are, in order: drive (rad or N m), carriage (m), inserted
length (m), axial speed (m/s), torque at the tip (N m, positive resists), relative change of tissue
that varies.
"""

from dataclasses import dataclass
from functools import cached_property

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import Drive, DriveKind
from models.errors import InvalidValue
from models.needle import Needle
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation, Mesh, SlipRate, node_positions_mm
from sim.kernel import memory_map
from sim.law_table import law_table
from sim.needles.shaft_bodies import ShaftBodies, shaft_bodies

Array = NDArray[np.float64]

# A rigid servo is this much stiffer than the needle: its error is 1e-6 of the lag.
_RIGID = 1e6
_NEVER_RAD = 1e6  # a stop that no slip comes to
_RAIL_RATE = 1e3  # rad/s, natural frequency of the carriage's servo
_CARRIAGE_MASS = 0.1  # kg
_CARRIAGE_INERTIA = 1e-5  # kg m^2; the carriage does not turn


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
            sheath=self.drive.sheath_friction_n_mm_per_mm > 0,
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


def _arena_bytes(joints: int) -> int:
    """Working memory of a step, bytes: no contacts, but some dense matrices of the joints."""
    return 1_000_000 + 32 * 8 * joints * joints


def needle_spec(setup: Setup) -> mujoco.MjSpec:
    """The model as an editable MuJoCo specification.

    Raises:
      InvalidValue: an element is too small for MuJoCo's floor on inertia.
    """
    spec = mujoco.MjSpec()
    spec.modelname = "needle"
    spec.option.timestep = setup.discretisation.step_s
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    spec.option.gravity = [0, 0, 0]
    spec.memory = _arena_bytes(setup.nodes_mm.size + 1)
    disable = mujoco.mjtDisableBit
    spec.option.disableflags = int(
        disable.mjDSBL_CONSTRAINT | disable.mjDSBL_CONTACT | disable.mjDSBL_AUTORESET
    )
    _add_numbers(spec, setup)
    tip = _add_bodies(spec, setup)
    _add_actuators(spec, setup, tip)
    for name in memory_map.OUTPUT_SENSORS:
        spec.add_sensor(
            name=name,
            type=mujoco.mjtSensor.mjSENS_USER,
            dim=1,
            needstage=mujoco.mjtStage.mjSTAGE_VEL,  # after the passive force, before accelerations
        )
    return spec


def set_numbers(model: mujoco.MjModel, setup: Setup) -> None:
    """Write the numbers of a set-up, but those of its bodies, into a model of the same `size`."""
    model.opt.timestep = setup.discretisation.step_s
    model.numeric_data[:] = np.concatenate(list(_numbers(setup).values()))
    stiffness = _joint_stiffness(setup)
    model.jnt_stiffness[:] = stiffness
    model.actuator_gear[memory_map.U_DRIVE, 0] = _drive_gear(setup)
    model.actuator_gear[memory_map.U_CARRIAGE, 0] = stiffness[0]  # a servo's motor has its spring's
    if setup.drive.torque_limit_n_mm is not None:
        model.actuator_forcerange[memory_map.U_DRIVE] = _torque_range_n_m(setup.drive.torque_limit_n_mm)


def set_bodies(model: mujoco.MjModel, setup: Setup) -> None:
    """Write where the bodies are, and their mass, into a model of the same `size`.

    With `set_numbers` before and `mj_setConst` after it, the model is that which
    compilation would give, at a fraction of the cost.
    """
    bodies, shaft = setup.bodies, slice(memory_map.FIRST_BODY, None)
    half, radius = bodies.half_length_m, bodies.radius_m
    model.body_pos[shaft, 0] = bodies.from_parent_m(chain=setup.is_chain)
    model.body_ipos[shaft, 0] = model.geom_pos[:, 0] = bodies.centre_m
    model.body_mass[shaft], model.body_inertia[shaft] = bodies.mass_kg, bodies.inertia_kg_m2
    model.geom_size[:, 0], model.geom_size[:, 1] = radius, half
    model.geom_rbound[:] = model.geom_aabb[:, 5] = half + radius  # capsules point along their z
    model.geom_aabb[:, 3:5] = radius
    model.site_size[:] = _tip_size(setup)


def _joint_stiffness(setup: Setup) -> Array:
    """Of the carriage, N / m, the servo and the joints along the shaft, N m / rad."""
    torsion = springs_n_m_per_rad(setup) if setup.is_chain else np.zeros(setup.nodes_mm.size - 1)
    return np.concatenate([[_rail_n_per_m(setup), setup.servo_n_m_per_rad], torsion])


def _drive_gear(setup: Setup) -> float:
    return setup.servo_n_m_per_rad if setup.drive.kind is DriveKind.ANGLE else 1.0


def _torque_range_n_m(most_n_mm: float) -> list[float]:
    return [-most_n_mm * units.N_MM, most_n_mm * units.N_MM]


def _tip_size(setup: Setup) -> float:
    return 2 * setup.needle.radius_mm * units.MM


def _mass_kg(setup: Setup) -> float:
    shaft = (setup.nodes_mm[-1] - setup.nodes_mm[0]) * units.MM
    return float(setup.needle.mass_kg_per_m * shaft)


def _rail_n_per_m(setup: Setup) -> float:
    return (_mass_kg(setup) + _CARRIAGE_MASS) * _RAIL_RATE**2


def _advection_coefficient(setup: Setup) -> float:
    """c in: slip rate = omega + c v dtheta/dx."""
    share = setup.slip_share
    if share is None:
        share = 1.0 if setup.discretisation.slip is SlipRate.MATERIAL_DERIVATIVE else 0.0
    return share - 1.0 if setup.mesh is Mesh.LAGRANGIAN else share


def header(setup: Setup, *, rows: int) -> Array:
    """The `needle` numeric of `sim.kernel.memory_map`, SI."""
    head = np.zeros(memory_map.HEADER)
    head[memory_map.H_MAGIC] = memory_map.MAGIC
    head[memory_map.H_ELEMENTS] = setup.nodes_mm.size - 1
    head[memory_map.H_ROWS] = rows
    head[memory_map.H_ORDER] = setup.discretisation.order
    head[memory_map.H_BACKLASH] = 0.5 * setup.drive.backlash_deg * units.DEG
    head[memory_map.H_GRIP] = (setup.drive.grip_torque_n_mm or 0.0) * units.N_MM
    stop_deg = setup.drive.grip_play_deg
    head[memory_map.H_STOP] = _NEVER_RAD if stop_deg is None else 0.5 * stop_deg * units.DEG
    head[memory_map.H_SPRING] = setup.drive.grip_stiffness_n_mm_per_rad * units.N_MM
    head[memory_map.H_PRESLIDING] = setup.discretisation.presliding_deg * units.DEG
    head[memory_map.H_RADIUS] = setup.needle.radius_mm * units.MM
    head[memory_map.H_ADVECTION] = _advection_coefficient(setup)
    head[memory_map.H_STRETCHING] = setup.stretching
    head[memory_map.H_FED] = setup.mesh is Mesh.FED
    head[memory_map.H_FREE_REF] = setup.free_mm * units.MM
    if setup.needle.stiffness_curve:
        head[memory_map.H_STIFFNESS_TORQUE] = setup.needle.stiffness_torque_n_mm * units.N_MM
        curve = slice(memory_map.H_STIFFNESS_0, memory_map.H_YIELD)
        head[curve] = np.log(setup.needle.stiffness_curve)
    head[memory_map.H_YIELD] = (setup.needle.yield_torque_n_mm or 0.0) * units.N_MM
    head[memory_map.H_YIELD_SLOPE] = setup.needle.yield_stiffness_ratio
    head[memory_map.H_CREEP] = setup.needle.creep_ratio
    head[memory_map.H_CREEP_TIME] = setup.needle.creep_time_s
    head[memory_map.H_SHAFT_DAMPING] = setup.needle.damping_time_s
    head[memory_map.H_CHAIN] = setup.is_chain
    head[memory_map.H_JOINT] = 0.5 * setup.needle.joint_play_deg * units.DEG
    head[memory_map.H_JOINT_AT] = _joint_at(setup)
    return head


def _joint_at(setup: Setup) -> float:
    """The element that the joint is in; between the middles of two, the part that is in the second."""
    middles = _from_tip_mm(setup)
    return float(np.interp(-setup.needle.joint_from_tip_mm, -middles, np.arange(middles.size)))


def _from_tip_mm(setup: Setup) -> Array:
    """Middles of the elements, from the tip, at the start, (n,)."""
    nodes = setup.nodes_mm
    return np.asarray(nodes[-1] - 0.5 * (nodes[1:] + nodes[:-1]))


def springs_n_m_per_rad(setup: Setup) -> Array:
    """Torsional stiffness kappa / a of every element at the start, (n,)."""
    rigidity, nodes = setup.needle.rigidity_n_mm2 * units.N_MM2, setup.nodes_mm
    stiffness: Array = rigidity / (np.diff(nodes) * units.MM)
    return stiffness * setup.needle.stiffness_factors(_from_tip_mm(setup))


def _numbers(setup: Setup) -> dict[str, Array]:
    """The numeric fields of `sim.kernel.memory_map` by name, in their order."""
    fields = {
        "needle": header(setup, rows=len(setup.law)),
        "needle_mesh": setup.nodes_mm * units.MM,
        "needle_law": setup.law.ravel(),
    }
    if not setup.is_chain:
        fields["needle_springs"] = springs_n_m_per_rad(setup)
    return fields


def _add_numbers(spec: mujoco.MjSpec, setup: Setup) -> None:
    for name, values in _numbers(setup).items():
        spec.add_numeric(name=name, data=values, size=values.size)
    spec.nuserdata = memory_map.userdata(setup.nodes_mm.size - 1, len(setup.law))


def _add_bodies(spec: mujoco.MjSpec, setup: Setup) -> str:
    """Carriage and shaft; returns the name of the site at the tip."""
    carriage = spec.worldbody.add_body(
        name="carriage",
        mass=_CARRIAGE_MASS,
        ipos=[0, 0, 0],
        inertia=[_CARRIAGE_INERTIA] * 3,
        explicitinertial=True,
    )
    rail = carriage.add_joint(name="carriage", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[1, 0, 0])
    stiffness = _joint_stiffness(setup)
    rail.stiffness = [stiffness[0], 0, 0]
    parent, bodies = carriage, setup.bodies
    for i, x in enumerate(bodies.from_parent_m(chain=setup.is_chain)):
        body = parent.add_body(
            name=f"shaft_{i}",
            pos=[x, 0, 0],
            mass=bodies.mass_kg[i],
            ipos=[bodies.centre_m[i], 0, 0],
            inertia=bodies.inertia_kg_m2[i],
            explicitinertial=True,
        )
        joint = body.add_joint(name=f"twist_{i}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[1, 0, 0])
        joint.stiffness = [stiffness[memory_map.FIRST_JOINT + i], 0, 0]
        body.add_geom(
            name=f"shaft_{i}",
            type=mujoco.mjtGeom.mjGEOM_CAPSULE,
            fromto=[-bodies.back_m[i], 0, 0, bodies.ahead_m[i], 0, 0],
            size=[bodies.radius_m, 0, 0],
            contype=0,
            conaffinity=0,
            mass=0,
            rgba=[0.75, 0.78, 0.82, 1],
        )
        parent = body if setup.is_chain else carriage
    body.add_site(name="tip", size=[_tip_size(setup)] * 3)
    return "tip"


def _add_actuators(spec: mujoco.MjSpec, setup: Setup, tip: str) -> None:
    joint, site = mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_SITE
    for name, target, kind, gear in (
        ("drive", "twist_0", joint, [_drive_gear(setup)]),
        ("carriage", "carriage", joint, [_rail_n_per_m(setup)]),
        ("inserted", "carriage", joint, [0]),
        ("speed", "carriage", joint, [0]),
        ("tip_torque", tip, site, [0, 0, 0, -1]),
        ("tissue", "carriage", joint, [0]),
    ):
        actuator = spec.add_actuator(name=name, target=target, trntype=kind)
        actuator.gear[: len(gear)] = gear
    if setup.drive.torque_limit_n_mm is not None:
        motor = spec.actuator("drive")
        motor.forcelimited = True
        motor.forcerange = _torque_range_n_m(setup.drive.torque_limit_n_mm)

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

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from sim.kernel import memory_map
from sim.needles.numeric_fields import numeric_fields, springs_n_m_per_rad
from sim.needles.setup import Setup

Array = NDArray[np.float64]

_RAIL_RATE = 1e3  # rad/s, natural frequency of the carriage's servo
_CARRIAGE_MASS = 0.1  # kg
_CARRIAGE_INERTIA = 1e-5  # kg m^2; the carriage does not turn


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
    model.numeric_data[:] = np.concatenate(list(numeric_fields(setup).values()))
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


def _add_numbers(spec: mujoco.MjSpec, setup: Setup) -> None:
    for name, values in numeric_fields(setup).items():
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

"""An independent needle: MuJoCo's own inertia, dampers, springs and actuators, and no callback.

The shaft is cut at nodes a apart. Every node is a body on a hinge about the shaft's
axis, so that joint angles are absolute, and represents half an element on either side:
rotary inertia eta a, and beta a of the tissue's damping as `joint.damping`. Torsion
kappa / a between neighbours is a position actuator that holds 0 on a fixed tendon, whose
length is theta_{i+1} - theta_i. (A tendon's own spring is slack at exactly its rest length,
and its stiffness is then absent from the implicit step: a shaft at rest would let each step
pass one node only.) A free length is one spring kappa / f without damping. Where the drive
gives an angle, the spring next to the base is a position actuator whose `ctrl` is that angle:
a rigid base needs no body and no stiff servo. Where it gives a torque, a motor turns the
base's own node.

The chain is lumped (3), and every pole is that of the continuous needle times
(sin x / x)^2, x = w a / 2 with w the mode's wavenumber: smaller by less than x^2 / 3. Base-
driven with a free length, w solves tan(w l) sin(w a) / a = 1 / f instead of w tan(w l) = 1 / f,
and is larger by at most x^2 / 3: the error of the pole is at most x^2 / 3, of either sign. MuJoCo's
integrator `discrete` is implicit in position and velocity; on a linear model its step is that
of backward Euler,

    (M s^2 + D s + K) theta = 0,   s = (1 - 1/z) / h,   z = theta(t + h) / theta(t),

so that the identified poles are free of the step's error.

Units are mm, N mm, s, rad. In N m, the absolute residual at which MuJoCo stops iterating is
too coarse: rates are then off by 0.2 % at angles of a degree, and here by 2e-8.
"""

import math
from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray

from models.drive import DriveKind
from models.modes import InsertedNeedle

Array = NDArray[np.float64]

ELEMENTS = 128
# Relative to the preconditioned right-hand side of the step; conjugate gradients get there
# in at most as many iterations as there are nodes, but for rounding.
_TOLERANCE = 1e-12
_ITERATIONS_PER_NODE = 4
_JOINT, _TENDON = mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_TENDON


def pole_bound(mode: int, elements: int = ELEMENTS) -> float:
    """Relative error of the `mode`-th pole other than 0: x^2 / 3 at the torque-driven x, the largest."""
    return (mode * math.pi / (2 * elements)) ** 2 / 3


@dataclass(frozen=True, kw_only=True)
class _Node:
    """A body: the length of shaft that turns with it, and how much of it is in tissue, mm."""

    shaft_mm: float
    covered_mm: float


def native_spec(rig: InsertedNeedle, *, step_s: float, elements: int = ELEMENTS) -> mujoco.MjSpec:
    """The needle as an editable MuJoCo specification.

    Its first input is the base's angle, rad, or torque, N mm; the others have to stay 0.

    Args:
      rig: needle, tissue, lengths and drive.
      step_s: MuJoCo's time step, s.
      elements: number of elements of the inserted length.
    """
    nodes, springs = _nodes(rig, elements), _springs_n_mm(rig, elements)
    between = springs[1:] if rig.drive is DriveKind.ANGLE else springs
    spec = mujoco.MjSpec()
    spec.modelname = "native needle"
    _set_options(spec, step_s, iterations=_ITERATIONS_PER_NODE * len(nodes))
    for i, node in enumerate(nodes):
        _add_node(spec, rig, node, i)
    base = spec.add_actuator(name="base", target="node_0", trntype=_JOINT)
    if rig.drive is DriveKind.ANGLE:
        base.set_to_position(kp=springs[0])
    for i, stiffness in enumerate(between):
        _add_spring(spec, stiffness, i)
    return spec


def _nodes(rig: InsertedNeedle, elements: int) -> list[_Node]:
    """Bodies from the base to the tip; a base with a given angle is not among them."""
    a, half_free = rig.inserted_mm / elements, rig.free_mm / 2
    inner = [_Node(shaft_mm=a, covered_mm=a)] * (elements - 1)
    tip = _Node(shaft_mm=a / 2, covered_mm=a / 2)
    entry = _Node(shaft_mm=a / 2 + half_free, covered_mm=a / 2)
    base = [_Node(shaft_mm=half_free, covered_mm=0.0)] if rig.free_mm else []
    nodes = [*base, entry, *inner, tip]
    return nodes[1:] if rig.drive is DriveKind.ANGLE else nodes


def _springs_n_mm(rig: InsertedNeedle, elements: int) -> list[float]:
    """Torsional stiffness of free length and elements, from the base on, N mm / rad."""
    kappa = rig.needle.rigidity_n_mm2
    free = [kappa / rig.free_mm] if rig.free_mm else []
    return free + [kappa * elements / rig.inserted_mm] * elements


def _set_options(spec: mujoco.MjSpec, step_s: float, *, iterations: int) -> None:
    spec.option.timestep = step_s
    spec.option.integrator = mujoco.mjtIntegrator.mjINT_DISCRETE
    spec.option.gravity = [0, 0, 0]
    spec.option.tolerance = _TOLERANCE
    spec.option.iterations = iterations


def _add_node(spec: mujoco.MjSpec, rig: InsertedNeedle, node: _Node, i: int) -> None:
    inertia = rig.needle.rotary_inertia_kg_m * node.shaft_mm  # kg m is N s^2
    tonnes = rig.needle.mass_kg_per_m * 1e-6 * node.shaft_mm
    body = spec.worldbody.add_body(
        name=f"node_{i}", mass=tonnes, ipos=[0, 0, 0], inertia=[inertia] * 3, explicitinertial=True
    )
    joint = body.add_joint(name=f"node_{i}", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[1, 0, 0])
    joint.damping = [rig.damping_n_mm_s_per_mm * node.covered_mm, 0, 0]


def _add_spring(spec: mujoco.MjSpec, stiffness: float, i: int) -> None:
    """Add a torsional spring between node i and the next."""
    tendon = spec.add_tendon(name=f"twist_{i}")
    tendon.wrap_joint(f"node_{i}", -1.0)
    tendon.wrap_joint(f"node_{i + 1}", 1.0)
    spring = spec.add_actuator(name=f"torsion_{i}", target=tendon.name, trntype=_TENDON)
    spring.set_to_position(kp=stiffness)


def released(rig: InsertedNeedle, *, step_s: float, steps: int, elements: int = ELEMENTS) -> Array:
    """Angles after each step, (steps, nodes, releases); in column j, node j was twisted and released."""
    model = native_spec(rig, step_s=step_s, elements=elements).compile()
    angles: Array = _stepped(model, np.eye(model.nq), np.zeros(steps)).transpose(1, 2, 0)
    return angles


def respond(rig: InsertedNeedle, drive: Array, *, step_s: float, elements: int = ELEMENTS) -> Array:
    """Angles of the nodes from rest, base to tip, rad, (N, nodes).

    Args:
      drive: base angle, rad, or base torque, N mm, at the end of each step, (N,).
    """
    model = native_spec(rig, step_s=step_s, elements=elements).compile()
    angles: Array = _stepped(model, np.zeros((1, model.nq)), drive)[0]
    return angles


def _stepped(model: mujoco.MjModel, start: Array, drive: Array) -> Array:
    """Angles after each step, (starts, steps, nodes)."""
    batch = Batch(model, len(start), 1)
    batch.reset(stage=int(mujoco.mjtStage.mjSTAGE_NONE))
    batch.qpos[:] = start
    ctrl = np.zeros((len(start), len(drive), model.nu))
    ctrl[:, :, 0] = drive
    angles: Array = batch.rollout(len(drive), ctrl)["qpos"]
    return angles


def tip_rad(rig: InsertedNeedle, time_s: Array, drive: Array, *, substeps: int = 2) -> Array:
    """The tip from rest, rad, (N,), extrapolated to a step of 0.

    Steps of h and h / 2 give 2 theta_{h/2} - theta_h (Richardson), which is second order.

    Args:
      time_s: equidistant times from 0, (N,).
      drive: base angle, rad, or base torque, N mm, at those times, straight between them, (N,).
      substeps: h is the distance of the times / this number.
    """
    coarse, fine = (_steps_to_tip(rig, time_s, drive, substeps=k * substeps) for k in (1, 2))
    extrapolated: Array = 2 * fine - coarse
    return extrapolated


def _steps_to_tip(rig: InsertedNeedle, time_s: Array, drive: Array, *, substeps: int) -> Array:
    steps = (time_s.size - 1) * substeps
    ends = time_s[-1] * np.arange(1, steps + 1) / steps
    angles = respond(rig, np.interp(ends, time_s, drive), step_s=time_s[-1] / steps)
    return np.concatenate([[0.0], angles[substeps - 1 :: substeps, -1]])

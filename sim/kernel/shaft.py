"""The needle as MuJoCo's model has it: inertia, springs, servo and motor.

`mjModel` is the only owner of these numbers: they are read from it at every step, so
that a model whose joint stiffness, body inertia, actuator or time step somebody
changes runs as physics says. What one element of the shaft has for MuJoCo,

    body_inertia (turned by body_iquat)    I of the node about the axis
    jnt_stiffness of its joint             k = kappa / a to the node before it

and what the base has: the joint spring and the motor of the same gear are a servo,
torque = gear * clamp(gain * ctrl) - k theta; without the spring the motor gives torque.

Siblings hinge on the carriage, where MuJoCo has no joint between neighbours: their
springs are the `needle_springs` of the model.
"""

from typing import NamedTuple

import numpy as np

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined


class ModelArrays(NamedTuple):
    """The arrays of `mjModel` that hold the needle, as MuJoCo names them."""

    body_inertia: np.ndarray  # (bodies, 3) principal moments
    body_iquat: np.ndarray  # (bodies, 4) their frame
    mass: float  # of the carriage and all that it carries, kg
    jnt_stiffness: np.ndarray  # (joints,)
    actuator_gear: np.ndarray  # (actuators, 6)
    actuator_gainprm: np.ndarray  # (actuators, mjNGAIN)
    actuator_forcelimited: np.ndarray  # (actuators,)
    actuator_forcerange: np.ndarray  # (actuators, 2)


class Motor(NamedTuple):
    """An actuator: force = gear * clamp(gain * ctrl)."""

    gear: float
    gain: float
    limited: bool
    low: float  # least and most of gain * ctrl, where it is limited
    high: float


class Shaft(NamedTuple):
    """Numbers of one model, SI; (n + 1) per node, (n) per element."""

    inertia: np.ndarray  # of the nodes about the axis, kg m^2
    spring: np.ndarray  # of the elements, N m / rad
    servo: float  # spring of the base joint, N m / rad; 0: the motor gives torque
    motor: Motor  # of the base
    tip: Motor  # of the torque at the tip, which resists
    mass: float  # of everything that the carriage moves, kg
    rail: float  # spring of the carriage, N / m
    rail_motor: Motor


@inlined
def motor_of(needle: ModelArrays, actuator: int, axis: int) -> Motor:
    """An actuator of the model; `axis` is the place of its gear: 0 for a joint."""
    return Motor(
        needle.actuator_gear[actuator, axis],
        needle.actuator_gainprm[actuator, 0],
        needle.actuator_forcelimited[actuator],
        needle.actuator_forcerange[actuator, 0],
        needle.actuator_forcerange[actuator, 1],
    )


@inlined
def motor_force(motor: Motor, ctrl: float) -> float:
    """Force of an actuator, N or N m."""
    force = motor.gain * ctrl
    if motor.limited:
        force = min(max(force, motor.low), motor.high)
    return motor.gear * force


@inlined
def drive_input(shaft: Shaft, ctrl: float) -> float:
    """What the base is given: the angle at which its servo rests, rad, or a torque, N m."""
    force = motor_force(shaft.motor, ctrl)
    return force / shaft.servo if shaft.servo > 0.0 else force


@inlined
def axial_inertia(inertia: Array, quat: Array) -> float:
    """Moment about the body's x axis from principal moments and their frame, kg m^2."""
    if quat[0] == 1.0:
        return inertia[0]
    w, x, y, z = quat[0], quat[1], quat[2], quat[3]
    first = w * w + x * x - y * y - z * z
    second = 2.0 * (x * y - w * z)
    third = 2.0 * (x * z + w * y)
    return first * first * inertia[0] + second * second * inertia[1] + third * third * inertia[2]


@inlined
def read_nodes(body_inertia: Array, body_iquat: Array, out: Array) -> None:
    """Inertia of every node, from the bodies of the whole model."""
    for i in range(out.size):
        body = memory_map.FIRST_BODY + i
        out[i] = axial_inertia(body_inertia[body], body_iquat[body])


@inlined
def read_springs(chain: bool, jnt_stiffness: Array, siblings: Array, out: Array) -> None:
    """Springs between neighbours: of the chain's joints, or the siblings' own."""
    for e in range(out.size):
        out[e] = jnt_stiffness[memory_map.FIRST_JOINT + 1 + e] if chain else siblings[e]

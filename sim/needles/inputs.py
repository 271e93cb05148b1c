"""The inputs of needles as MuJoCo takes them, in SI units, and the state that a run begins in."""

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import NDArray

from models import units
from models.drive import DriveKind
from models.errors import InvalidValue
from sim.kernel import memory_map
from sim.needles.setup import Setup
from sim.schedule import Schedule

Array = NDArray[np.float64]


def at_steps(inputs: Schedule | Sequence[Schedule], count: int, step_s: float) -> list[Schedule]:
    """The inputs of every set-up at the ends of steps; shared ones stay shared."""
    each = [inputs] * count if isinstance(inputs, Schedule) else list(inputs)
    if len(each) != count:
        raise InvalidValue("inputs", len(each), f"one schedule, or one for each of {count} set-ups")
    stepped = [own.at_steps(step_s) for own in each]
    spans = {(float(own.time_s[0]), own.time_s.size) for own in stepped}
    if len(spans) > 1:
        raise InvalidValue(
            "inputs", sorted(spans), "schedules with the same start and the same number of steps"
        )
    return stepped


def controls(inputs: Schedule, setup: Setup) -> Array:
    """`ctrl` at every sample, SI, (N, inputs)."""
    ctrl = np.zeros((inputs.time_s.size, memory_map.INPUTS))
    scale = units.DEG if setup.drive.kind is DriveKind.ANGLE else units.N_MM
    ctrl[:, memory_map.U_DRIVE] = inputs.drive * scale
    ctrl[:, memory_map.U_CARRIAGE] = (setup.free_mm - inputs.free_mm) * units.MM
    ctrl[:, memory_map.U_INSERTED] = inputs.inserted_mm * units.MM
    ctrl[:, memory_map.U_SPEED] = inputs.speed_mm_s * units.MM
    ctrl[:, memory_map.U_TIP] = inputs.tip_torque_n_mm * units.N_MM
    ctrl[:, memory_map.U_TISSUE] = inputs.tissue_factor - 1.0
    return ctrl


def controls_of_each(inputs: Sequence[Schedule], setups: Sequence[Setup]) -> list[Array]:
    """`ctrl` of every set-up; those with the same inputs, drive and free length share it."""
    made: dict[tuple[Schedule, DriveKind, float], Array] = {}
    each = []
    for own, setup in zip(inputs, setups, strict=True):
        key = own, setup.drive.kind, setup.free_mm
        if key not in made:
            made[key] = controls(own, setup)
        each.append(made[key])
    return each


def initial_data(model: mujoco.MjModel, setup: Setup, ctrl: Array) -> mujoco.MjData:
    """Data of an untwisted needle at rest, at the first of the inputs.

    Args:
      ctrl: the inputs at the start, SI, (inputs,).
    """
    data = mujoco.MjData(model)
    data.qpos[:] = start_joints(setup, ctrl)
    data.ctrl[:] = ctrl
    mujoco.mj_forward(model, data)
    return data


def start_joints(setup: Setup, ctrl: Array) -> Array:
    """Joints of an untwisted needle, the carriage's first: m, then rad, (joints,)."""
    qpos = np.zeros(memory_map.FIRST_JOINT + setup.nodes_mm.size)
    qpos[0] = ctrl[memory_map.U_CARRIAGE]
    if setup.drive.kind is DriveKind.ANGLE:
        qpos[1 : 2 if setup.is_chain else None] = ctrl[memory_map.U_DRIVE]
    return qpos

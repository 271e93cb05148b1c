"""The compiled callbacks: MuJoCo's passive force and the sensors that show it.

MuJoCo's model holds the needle, and MuJoCo steps it. The passive callback finds the arrays of
model and data in MuJoCo's structs and updates tissue and passive torques (sim.kernel.update).

mjcb_* are process-wide. A model without our header passes through untouched.
"""

import hashlib
import logging
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numba
from numba import carray, cfunc, types

from sim.kernel import memory_map
from sim.kernel.native.large_frame import with_large_frame
from sim.kernel.native.pointers import addresses, flags, numbers
from sim.kernel.native.struct_offsets import read_struct_offsets
from sim.kernel.shaft import ModelArrays
from sim.kernel.update import block, update, userdata_size

_SOURCES = Path(__file__).parents[1]
_STAGE = int(mujoco.mjtStage.mjSTAGE_VEL)


def _sources_digest() -> int:
    """Changes whenever a source of the compiled code does: part of the cache key."""
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(_SOURCES.rglob("*.py")):
        digest.update(source.read_bytes())
    return int.from_bytes(digest.digest()[:6], "big")


def _compile() -> tuple[Any, Any]:
    """The passive and the sensor callback for the installed MuJoCo.

    The offsets and the digest are closure variables, and so part of the key under
    which numba caches the machine code.
    """
    offsets, build = read_struct_offsets(), _sources_digest()
    count_at, numeric_at = offsets.model["nnumeric"], offsets.model["numeric_data"]
    step_at, time_at = offsets.model["timestep"], offsets.data["time"]
    size_at = offsets.model["nnumericdata"]
    inertia_at, quat_at = offsets.model["body_inertia"], offsets.model["body_iquat"]
    mass_at, stiffness_at = offsets.model["body_subtreemass"], offsets.model["jnt_stiffness"]
    gear_at, gain_at = offsets.model["actuator_gear"], offsets.model["actuator_gainprm"]
    limited_at = offsets.model["actuator_forcelimited"]
    range_at = offsets.model["actuator_forcerange"]
    qpos_at, qvel_at, ctrl_at = (offsets.data[name] for name in ("qpos", "qvel", "ctrl"))
    passive_at, user_at = offsets.data["qfrc_passive"], offsets.data["userdata"]
    sensors_at = offsets.data["sensordata"]

    @cfunc(types.void(types.intp, types.intp), cache=True)
    def passive(model: int, data: int) -> None:
        if build == 0 or addresses(model + count_at)[0] == 0:
            return
        start = addresses(model + numeric_at)[0]
        head = carray(numbers(start), memory_map.HEADER)
        if head[memory_map.H_MAGIC] != memory_map.MAGIC:
            return
        n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
        bodies = memory_map.FIRST_BODY + n + 1
        needle = ModelArrays(
            carray(numbers(addresses(model + inertia_at)[0]), (bodies, 3)),
            carray(numbers(addresses(model + quat_at)[0]), (bodies, 4)),
            numbers(addresses(model + mass_at)[0])[memory_map.FIRST_BODY - 1],
            carray(numbers(addresses(model + stiffness_at)[0]), n + 2),
            carray(numbers(addresses(model + gear_at)[0]), (memory_map.INPUTS, 6)),
            carray(numbers(addresses(model + gain_at)[0]), (memory_map.INPUTS, mujoco.mjNGAIN)),
            carray(flags(addresses(model + limited_at)[0]), memory_map.INPUTS),
            carray(numbers(addresses(model + range_at)[0]), (memory_map.INPUTS, 2)),
        )
        update(
            carray(numbers(start), addresses(model + size_at)[0]),
            needle,
            numbers(model + step_at)[0],
            numbers(data + time_at)[0],
            carray(numbers(addresses(data + qpos_at)[0]), n + 2),
            carray(numbers(addresses(data + qvel_at)[0]), n + 2),
            carray(numbers(addresses(data + ctrl_at)[0]), memory_map.INPUTS),
            carray(numbers(addresses(data + user_at)[0]), userdata_size(n, rows)),
            carray(numbers(addresses(data + passive_at)[0]), n + 2),
        )

    @cfunc(types.void(types.intp, types.intp, types.intc), cache=True)
    def sensor(model: int, data: int, stage: int) -> None:
        if build == 0 or addresses(model + count_at)[0] == 0 or stage != _STAGE:
            return
        head = carray(numbers(addresses(model + numeric_at)[0]), memory_map.HEADER)
        if head[memory_map.H_MAGIC] != memory_map.MAGIC:
            return
        size = block(int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS]))
        user = carray(numbers(addresses(data + user_at)[0]), memory_map.CLOCK + 2 * size)
        shown = carray(numbers(addresses(data + sensors_at)[0]), memory_map.OUTPUTS)
        for i in range(memory_map.OUTPUTS):
            shown[i] = user[memory_map.CLOCK + size + i]

    return passive, sensor


@cache
def install() -> tuple[Any, Any]:
    """Compile (once per machine) and install both callbacks; safe to call again."""
    passive, sensor = with_large_frame(_compile)
    mujoco.set_mjcb_passive(passive.ctypes)
    mujoco.set_mjcb_sensor(sensor.ctypes)
    mujoco.set_mjcb_time(None)  # the clock of MuJoCo's profiler costs a tenth of a step
    if mujoco.get_mju_user_warning() is None:
        # A run that loses its numbers raises; MuJoCo would also write a file where it is called.
        mujoco.set_mju_user_warning(logging.getLogger("mujoco").info)
    return passive, sensor

"""The compiled callbacks: MuJoCo's passive force and the sensors that show it.

What MuJoCo computes: the inertia of the chain, its joint springs, the motors, the
solution of its own implicit step, and the new state. What the callback computes:
the end of the step of needle and tissue together (sim.kernel.step), and from it
the joint torques with which MuJoCo's own step lands there:

    passive = M a + K q_end - motor,    a = ((q_end - q) / h - qvel) / h,

where K are the joints' springs, which MuJoCo's integrator evaluates at the end of
the step. In the mean over the step these torques are the tissue's.

The state of the tissue at the start and at the end of a step are kept apart in
`userdata`, and the end becomes the start only when time has moved on: so that
`mj_forward` may be called any number of times.

mjcb_* are process-wide. A model without our header passes through untouched.
"""

import hashlib
import logging
from functools import cache
from pathlib import Path
from typing import Any

import mujoco
import numba
from numba import carray, cfunc, njit, types
from numba.extending import intrinsic

from sim.kernel import memory_map
from sim.kernel.assemble import is_linear
from sim.kernel.compiled import Array, compiled, inlined
from sim.kernel.step import advance
from sim.kernel.struct_offsets import read_struct_offsets

_SOURCES = Path(__file__).parent
_STAGE = int(mujoco.mjtStage.mjSTAGE_ACC)


def _pointer_to(kind: Any) -> Any:
    """An intrinsic that reads an integer address as a pointer to `kind`."""

    @intrinsic
    def pointer(typingctx: Any, address: Any) -> Any:
        def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return builder.inttoptr(args[0], context.get_value_type(signature.return_type))

        return types.CPointer(kind)(types.intp), codegen

    return pointer


_numbers = _pointer_to(types.float64)
_addresses = _pointer_to(types.intp)
_block: Any = njit(memory_map.block)
_scratch: Any = njit(memory_map.scratch)


@inlined
def _userdata(n: int, rows: int) -> int:
    """memory_map.userdata, for compiled code."""
    return memory_map.CLOCK + 2 * _block(n, rows) + _scratch(n, rows)


@inlined
def _torques(
    head: Array,
    mesh: Array,
    h: float,
    qpos: Array,
    qvel: Array,
    theta: Array,
    end: Array,
    ctrl: Array,
    passive: Array,
) -> None:
    """Add to `passive` what makes MuJoCo's own step end at the angles `end`."""
    n = int(head[memory_map.H_ELEMENTS])
    chain = head[memory_map.H_CHAIN] != 0.0
    rail = ((ctrl[memory_map.U_CARRIAGE] - qpos[0]) / h - qvel[0]) / h
    passive[0] += head[memory_map.H_MASS] * rail
    rate = 0.0
    for i in range(n + 1):  # for the chain: absolute rates, kept in theta's place
        rate = qvel[i + 1] + (rate if chain else 0.0)
        theta[i] = ((end[i] - theta[i]) / h - rate) / h
    inertial = 0.0
    for i in range(n, -1, -1):
        left = mesh[i] - mesh[i - 1] if i > 0 else 0.0
        right = mesh[i + 1] - mesh[i] if i < n else 0.0
        inertia = head[memory_map.H_ETA] * 0.5 * (left + right)
        inertial = inertia * theta[i] + (inertial if chain else 0.0)
        torque = inertial
        if i == 0:
            angle_driven = head[memory_map.H_DRIVE] == memory_map.DRIVE_ANGLE
            torque += (
                head[memory_map.H_SERVO] * (end[0] - ctrl[memory_map.U_DRIVE])
                if angle_driven
                else -ctrl[memory_map.U_DRIVE]
            )
        elif chain:
            torque += head[memory_map.H_KAPPA] / left * (end[i] - end[i - 1])
        if chain or i == n:
            torque += ctrl[memory_map.U_TIP]
        passive[i + 1] += torque


@inlined
def _prime(head: Array, theta: Array, ctrl: Array, now: Array) -> None:
    """Before the first step: everything at rest, as the inputs and angles stand."""
    now[:] = 0.0
    now[memory_map.B_INPUTS : memory_map.B_INPUTS + memory_map.INPUTS] = ctrl
    if head[memory_map.H_DRIVE] == memory_map.DRIVE_ANGLE:
        now[memory_map.B_INPUTS + memory_map.U_DRIVE] = theta[0]
    now[memory_map.B_ANGLES : memory_map.B_ANGLES + theta.size] = theta


@inlined
def _remembers(law: Array) -> bool:
    found = False
    for r in range(law.shape[0]):
        found = found or not is_linear(law[r])
    return found


@compiled
def step_needle(
    numeric: Array,
    h: float,
    time: float,
    qpos: Array,
    qvel: Array,
    ctrl: Array,
    userdata: Array,
    passive: Array,
) -> None:
    """What the passive callback does, on arrays."""
    head = numeric[: memory_map.HEADER]
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    mesh = numeric[memory_map.HEADER : memory_map.HEADER + n + 1]
    law = numeric[
        memory_map.HEADER + n + 1 : memory_map.HEADER + n + 1 + rows * memory_map.COLUMNS
    ].reshape(rows, memory_map.COLUMNS)
    size = _block(n, rows)
    now = userdata[memory_map.CLOCK : memory_map.CLOCK + size]
    nxt = userdata[memory_map.CLOCK + size : memory_map.CLOCK + 2 * size]
    theta = userdata[memory_map.CLOCK + 2 * size : memory_map.CLOCK + 2 * size + n + 1]
    scratch = userdata[memory_map.CLOCK + 2 * size + n + 1 :]
    angle = 0.0
    for i in range(n + 1):
        angle = qpos[i + 1] + (angle if head[memory_map.H_CHAIN] != 0.0 else 0.0)
        theta[i] = angle
    if userdata[memory_map.D_PRIMED] == 0.0:
        _prime(head, theta, ctrl, now)
        userdata[memory_map.D_PRIMED] = 1.0
    elif time > userdata[memory_map.D_TIME]:
        # Rows that are viscous alone remember nothing at their sites.
        kept = size if _remembers(law) else memory_map.B_ANGLES + 2 * (n + 1)
        now[:kept] = nxt[:kept]
        for i in range(n + 1):
            now[memory_map.O_LANDING] = max(
                now[memory_map.O_LANDING], abs(theta[i] - now[memory_map.B_ANGLES + i])
            )
    userdata[memory_map.D_TIME] = time
    advance(head, mesh, law, h, theta, now, nxt, ctrl, scratch)
    nxt[memory_map.O_LANDING] = now[memory_map.O_LANDING]
    _torques(
        head,
        mesh,
        h,
        qpos,
        qvel,
        theta,
        nxt[memory_map.B_ANGLES : memory_map.B_ANGLES + n + 1],
        ctrl,
        passive,
    )


def _sources_digest() -> int:
    """Changes whenever a source of the compiled code does: part of the cache key."""
    digest = hashlib.sha256(numba.__version__.encode())
    for source in sorted(_SOURCES.glob("*.py")):
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
    qpos_at, qvel_at, ctrl_at = (offsets.data[name] for name in ("qpos", "qvel", "ctrl"))
    passive_at, user_at = offsets.data["qfrc_passive"], offsets.data["userdata"]
    sensors_at = offsets.data["sensordata"]

    @cfunc(types.void(types.intp, types.intp), cache=True)
    def passive(model: int, data: int) -> None:
        if build == 0 or _addresses(model + count_at)[0] == 0:
            return
        start = _addresses(model + numeric_at)[0]
        head = carray(_numbers(start), memory_map.HEADER)
        if head[memory_map.H_MAGIC] != memory_map.MAGIC:
            return
        n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
        step_needle(
            carray(_numbers(start), memory_map.HEADER + n + 1 + rows * memory_map.COLUMNS),
            _numbers(model + step_at)[0],
            _numbers(data + time_at)[0],
            carray(_numbers(_addresses(data + qpos_at)[0]), n + 2),
            carray(_numbers(_addresses(data + qvel_at)[0]), n + 2),
            carray(_numbers(_addresses(data + ctrl_at)[0]), memory_map.INPUTS),
            carray(_numbers(_addresses(data + user_at)[0]), _userdata(n, rows)),
            carray(_numbers(_addresses(data + passive_at)[0]), n + 2),
        )

    @cfunc(types.void(types.intp, types.intp, types.intc), cache=True)
    def sensor(model: int, data: int, stage: int) -> None:
        if build == 0 or _addresses(model + count_at)[0] == 0 or stage != _STAGE:
            return
        head = carray(_numbers(_addresses(model + numeric_at)[0]), memory_map.HEADER)
        if head[memory_map.H_MAGIC] != memory_map.MAGIC:
            return
        size = _block(int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS]))
        user = carray(_numbers(_addresses(data + user_at)[0]), memory_map.CLOCK + 2 * size)
        shown = carray(_numbers(_addresses(data + sensors_at)[0]), memory_map.OUTPUTS)
        shown[:] = user[memory_map.CLOCK + size : memory_map.CLOCK + size + memory_map.OUTPUTS]

    return passive, sensor


@cache
def install() -> tuple[Any, Any]:
    """Compile (once per machine) and install both callbacks; safe to call again."""
    passive, sensor = _compile()
    mujoco.set_mjcb_passive(passive.ctypes)
    mujoco.set_mjcb_sensor(sensor.ctypes)
    if mujoco.get_mju_user_warning() is None:
        # A run that loses its numbers raises; MuJoCo would also write a file where it is called.
        mujoco.set_mju_user_warning(logging.getLogger("mujoco").info)
    return passive, sensor

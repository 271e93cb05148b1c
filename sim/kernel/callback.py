"""The compiled callbacks: MuJoCo's passive force and the sensors that show it.

Who computes what: MuJoCo's model holds the needle, and MuJoCo steps it. The callback
finds the end of the step of needle and tissue together (sim.kernel.step) and adds to
`qfrc_passive` the torque of the tissue there, and what lifts MuJoCo's first-order step
to a higher one, apart from each other (sim.kernel.torques). In first-order mode the
tissue's torque is all that it adds.

The states of the tissue at the start and at the end of a step are kept apart in
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
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.shaft import ModelArrays, Shaft, motor_of, read_nodes, read_springs
from sim.kernel.stage.assemble import is_linear
from sim.kernel.step import advance
from sim.kernel.struct_offsets import read_struct_offsets
from sim.kernel.torques import inertia_torque, landing_force, landing_torque, to_joints
from sim.kernel.view import view

_SOURCES = Path(__file__).parent
_STAGE = int(mujoco.mjtStage.mjSTAGE_VEL)


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
_flags = _pointer_to(types.boolean)
_block: Any = njit(memory_map.block)
_sites_at: Any = njit(memory_map.sites_at)
_torques: Any = njit(memory_map.torques)
_scratch: Any = njit(memory_map.scratch)


@inlined
def _userdata(n: int, rows: int) -> int:
    """memory_map.userdata, for compiled code."""
    return memory_map.CLOCK + 2 * _block(n, rows) + _torques(n) + _scratch(n, rows)


@inlined
def _prime(shaft: Shaft, theta: Array, ctrl: Array, now: Array) -> None:
    """Before the first step: everything at rest, as the inputs and angles stand."""
    now[:] = 0.0
    for j in range(memory_map.INPUTS):
        now[memory_map.B_INPUTS + j] = ctrl[j]
    gain = shaft.motor.gear * shaft.motor.gain
    if shaft.servo > 0.0 and gain != 0.0:  # the drive shaft starts where the needle is
        now[memory_map.B_INPUTS + memory_map.U_DRIVE] = theta[0] * shaft.servo / gain
    for i in range(theta.size):
        now[memory_map.B_ANGLES + i] = theta[i]


@inlined
def _remembers(law: Array) -> bool:
    found = False
    for r in range(law.shape[0]):
        found = found or not is_linear(law[r])
    return found


@embedded
def _begin(
    law: Array,
    shaft: Shaft,
    time: float,
    theta: Array,
    ctrl: Array,
    clock: Array,
    now: Array,
    nxt: Array,
) -> None:
    """Make the end of the last step the start of this one, if time has moved on."""
    n = theta.size - 1
    if clock[memory_map.D_PRIMED] == 0.0:
        _prime(shaft, theta, ctrl, now)
        clock[memory_map.D_PRIMED] = 1.0
    elif time > clock[memory_map.D_TIME]:
        # Rows that are viscous alone remember nothing at their sites.
        kept = now.size if _remembers(law) else _sites_at(n)
        for i in range(kept):
            now[i] = nxt[i]
        for i in range(n + 1):
            now[memory_map.O_LANDING] = max(
                now[memory_map.O_LANDING], abs(theta[i] - now[memory_map.B_ANGLES + i])
            )
    clock[memory_map.D_TIME] = time


@embedded
def _add_torques(
    head: Array,
    shaft: Shaft,
    h: float,
    theta: Array,
    rates: Array,
    nxt: Array,
    ctrl: Array,
    torques: Array,
    passive: Array,
) -> None:
    """Add the torques to the hinges, and show the largest correction among them."""
    n = theta.size - 1
    chain = head[memory_map.H_CHAIN] != 0.0
    tissue, other = torques[memory_map.T_TISSUE], torques[memory_map.T_OTHER]
    correction = torques[memory_map.T_CORRECTION]
    to_joints(chain, tissue)
    largest = 0.0
    nxt[memory_map.O_INERTIA] = inertia_torque(shaft, h, theta, rates, nxt)
    if head[memory_map.H_ORDER] == 1.0:
        correction[:] = 0.0
    else:
        if shaft.servo > 0.0:
            # The last stage's own torque of a stiff servo rings where inertia counts.
            nxt[memory_map.O_BASE_TORQUE] = (
                nxt[memory_map.O_FRICTION] + nxt[memory_map.O_TIP_TORQUE] + nxt[memory_map.O_INERTIA]
            )
        end = view(nxt, memory_map.B_ANGLES, (n + 1,))
        landing_torque(chain, shaft, h, theta, rates, end, ctrl, correction)
        for i in range(n + 1):
            correction[i] -= tissue[i] + other[i]
            largest = max(largest, abs(correction[i]))
    nxt[memory_map.O_CORRECTION] = largest
    for i in range(n + 1):
        passive[memory_map.FIRST_JOINT + i] += tissue[i] + other[i] + correction[i]


@inlined
def _absolute(chain: bool, joints: Array, out: Array) -> None:
    """Angles or rates of the nodes from those of the hinges."""
    total = 0.0
    for i in range(out.size):
        total = joints[memory_map.FIRST_JOINT + i] + (total if chain else 0.0)
        out[i] = total


@embedded
def step_needle(
    numeric: Array,
    needle: ModelArrays,
    h: float,
    time: float,
    qpos: Array,
    qvel: Array,
    ctrl: Array,
    userdata: Array,
    passive: Array,
) -> None:
    """What the passive callback does, on arrays."""
    head = view(numeric, 0, (memory_map.HEADER,))
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    chain = head[memory_map.H_CHAIN] != 0.0
    size, m = _block(n, rows), n + 1
    mesh = view(numeric, memory_map.HEADER, (m,))
    law = view(numeric, memory_map.HEADER + m, (rows, memory_map.COLUMNS))
    springs = memory_map.HEADER + m + rows * memory_map.COLUMNS
    now = view(userdata, memory_map.CLOCK, (size,))
    nxt = view(userdata, memory_map.CLOCK + size, (size,))
    at = memory_map.CLOCK + 2 * size
    torques = view(userdata, at, (memory_map.TORQUES, m))
    at += _torques(n)
    theta, rates = view(userdata, at, (m,)), view(userdata, at + m, (m,))
    inertia, spring = view(userdata, at + 2 * m, (m,)), view(userdata, at + 3 * m, (n,))
    scratch = view(userdata, at + 4 * m, (_scratch(n, rows) - 4 * m,))
    read_nodes(needle.body_inertia, needle.body_iquat, inertia)
    read_springs(chain, needle.jnt_stiffness, view(numeric, springs, (n,)), spring)
    shaft = Shaft(
        inertia,
        spring,
        needle.jnt_stiffness[memory_map.FIRST_JOINT],
        motor_of(needle, memory_map.U_DRIVE, 0),
        motor_of(needle, memory_map.U_TIP, memory_map.ABOUT_X),
        needle.mass,
        needle.jnt_stiffness[0],
        motor_of(needle, memory_map.U_CARRIAGE, 0),
    )
    _absolute(chain, qpos, theta)
    _absolute(chain, qvel, rates)
    _begin(law, shaft, time, theta, ctrl, view(userdata, 0, (memory_map.CLOCK,)), now, nxt)
    second_order = head[memory_map.H_ORDER] != 1.0
    # MuJoCo's rates are means over a step; the method's own are those at its end.
    own = view(now, memory_map.B_ANGLES + m, (m,)) if second_order else rates
    advance(head, mesh, law, shaft, h, theta, own, now, nxt, ctrl, torques, scratch)
    nxt[memory_map.O_LANDING] = now[memory_map.O_LANDING]
    _add_torques(head, shaft, h, theta, rates, nxt, ctrl, torques, passive)
    if second_order:
        passive[0] += landing_force(shaft, h, qpos[0], qvel[0], ctrl[memory_map.U_CARRIAGE])


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
        if build == 0 or _addresses(model + count_at)[0] == 0:
            return
        start = _addresses(model + numeric_at)[0]
        head = carray(_numbers(start), memory_map.HEADER)
        if head[memory_map.H_MAGIC] != memory_map.MAGIC:
            return
        n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
        bodies = memory_map.FIRST_BODY + n + 1
        needle = ModelArrays(
            carray(_numbers(_addresses(model + inertia_at)[0]), (bodies, 3)),
            carray(_numbers(_addresses(model + quat_at)[0]), (bodies, 4)),
            _numbers(_addresses(model + mass_at)[0])[memory_map.FIRST_BODY - 1],
            carray(_numbers(_addresses(model + stiffness_at)[0]), n + 2),
            carray(_numbers(_addresses(model + gear_at)[0]), (memory_map.INPUTS, 6)),
            carray(_numbers(_addresses(model + gain_at)[0]), (memory_map.INPUTS, mujoco.mjNGAIN)),
            carray(_flags(_addresses(model + limited_at)[0]), memory_map.INPUTS),
            carray(_numbers(_addresses(model + range_at)[0]), (memory_map.INPUTS, 2)),
        )
        step_needle(
            carray(_numbers(start), _addresses(model + size_at)[0]),
            needle,
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
        for i in range(memory_map.OUTPUTS):
            shown[i] = user[memory_map.CLOCK + size + i]

    return passive, sensor


@cache
def install() -> tuple[Any, Any]:
    """Compile (once per machine) and install both callbacks; safe to call again."""
    passive, sensor = _compile()
    mujoco.set_mjcb_passive(passive.ctypes)
    mujoco.set_mjcb_sensor(sensor.ctypes)
    mujoco.set_mjcb_time(None)  # the clock of MuJoCo's profiler costs a tenth of a step
    if mujoco.get_mju_user_warning() is None:
        # A run that loses its numbers raises; MuJoCo would also write a file where it is called.
        mujoco.set_mju_user_warning(logging.getLogger("mujoco").info)
    return passive, sensor

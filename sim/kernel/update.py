"""What the passive callback does at one call of it, on arrays.

The states of the tissue at the start and at the end of a step are kept apart in
`userdata`, and the end becomes the start only when time has moved on: so that
`mj_forward` may be called any number of times.

The step of needle and tissue together (sim.kernel.step) says where the shaft has to land.
`qfrc_passive` gains the torque of the tissue there, and what lifts MuJoCo's first-order step
to a higher one, apart from each other (sim.kernel.torques). In first-order mode the
tissue's torque is all that it gains.
"""

from typing import Any

from numba import njit

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.shaft import ModelArrays, Shaft, motor_of, read_nodes, read_springs
from sim.kernel.stage.assemble import is_linear
from sim.kernel.step import advance
from sim.kernel.torques import inertia_torque, landing_force, landing_torque, to_joints
from sim.kernel.view import view

block: Any = njit(memory_map.block)
"""memory_map.block, for compiled code."""
_sites_at: Any = njit(memory_map.sites_at)
_torques: Any = njit(memory_map.torques)
_scratch: Any = njit(memory_map.scratch)


@inlined
def userdata_size(n: int, rows: int) -> int:
    """memory_map.userdata, for compiled code."""
    return memory_map.CLOCK + 2 * block(n, rows) + _torques(n) + _scratch(n, rows)


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
def update(
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
    """Add the passive torques of this moment, and keep where the step would end.

    Args:
      numeric: all numeric fields of the model, one after the other (sim.kernel.memory_map).
      needle: MuJoCo's own arrays of it.
      h, time: step and time, s.
      qpos, qvel: of the carriage, m and m/s, then of the hinges, rad and rad/s, (n + 2).
      ctrl: inputs at the end of the step, (INPUTS,).
      userdata: of MuJoCo's data, changed in place.
      passive: `qfrc_passive`, which gains the torques, N m, (n + 2).
    """
    head = view(numeric, 0, (memory_map.HEADER,))
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    chain = head[memory_map.H_CHAIN] != 0.0
    size, m = block(n, rows), n + 1
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
    siblings = view(numeric, springs, (0 if chain else n,))
    read_springs(chain, needle.jnt_stiffness, siblings, spring)
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
    advance(head, mesh, law, shaft, time, h, theta, own, now, nxt, ctrl, torques, scratch)
    nxt[memory_map.O_LANDING] = now[memory_map.O_LANDING]
    _add_torques(head, shaft, h, theta, rates, nxt, ctrl, torques, passive)
    if second_order:
        passive[0] += landing_force(shaft, h, qpos[0], qvel[0], ctrl[memory_map.U_CARRIAGE])

"""One step of needle and tissue together: second order, L-stable, sticking truly.

Alexander's two-stage singly diagonally implicit Runge-Kutta method, with
gamma = 1 - 1/sqrt(2): L-stable, second order, stiffly accurate. A stage of length
g = gamma h solves for the rates w of the nodes

    I (w - w*) / g + K (theta* + g w) + sum over sites of N f(N' w) = drive - tip,

a tridiagonal system, by Newton's method. Everything that is remembered (angles,
rates, presliding, tissue twist) enters the second stage as
y* = y0 + (1/gamma - 1)(y1 - y0). Inputs run straight from one end of the step to
the other; lengths and speed are those of its middle.
"""

import math

from sim.kernel import memory_map
from sim.kernel.advection import advect_tissue, forget_uncovered
from sim.kernel.assemble import (
    add_viscous,
    drive_torque,
    is_linear,
    twist_of,
)
from sim.kernel.compiled import Array, compiled, inlined
from sim.kernel.mesh import cover, place_nodes
from sim.kernel.newton import newton
from sim.kernel.workspace import Frame, Workspace, divide

GAMMA = 1.0 - math.sqrt(0.5)
_CARRY = 1.0 / GAMMA - 1.0


@inlined
def _prepare(
    head: Array,
    mesh: Array,
    law: Array,
    theta: Array,
    now: Array,
    before: Array,
    w: Workspace,
    frame: Frame,
    free: float,
    inserted: float,
    tip_loaded: bool,
) -> bool:
    """Fill in what the step starts from; returns whether iteration is needed."""
    n = w.omega.size - 1
    place_nodes(head, mesh, free, w.x)
    half = 0.5 * head[memory_map.H_ETA] / frame.g
    w.inertia[0] = half * (w.x[1] - w.x[0])
    w.inertia[n] = half * (w.x[n] - w.x[n - 1])
    for i in range(1, n):
        w.inertia[i] = half * (w.x[i + 1] - w.x[i - 1])
    for i in range(n):
        w.spring[i] = head[memory_map.H_KAPPA] / (w.x[i + 1] - w.x[i])
    for i in range(n + 1):
        w.theta[i] = theta[i]
        w.rest[i] = w.omega[i] = now[memory_map.B_ANGLES + n + 1 + i]
        w.damp_lower[i] = w.damp_diagonal[i] = w.damp_upper[i] = 0.0
    nonlinear = head[memory_map.H_BACKLASH] > 0.0
    for r in range(law.shape[0]):
        cover(law[r], w.x, free, inserted, tip_loaded, w.loads[r], w.point[r])
        if is_linear(law[r]):
            add_viscous(w, w.loads[r], law[r, memory_map.L_VISCOUS])
        else:
            nonlinear = True
            w.start[r] = before[r]
            w.end[r] = before[r]
    return nonlinear


@inlined
def _second_stage(
    law: Array, theta: Array, now: Array, before: Array, w: Workspace, frame: Frame
) -> None:
    """Carry everything that is remembered into the second stage."""
    n = w.omega.size - 1
    for i in range(n + 1):
        reached = w.theta[i] + frame.g * w.omega[i]
        w.theta[i] = theta[i] + _CARRY * (reached - theta[i])
        rate = now[memory_map.B_ANGLES + n + 1 + i]
        w.rest[i] = rate + _CARRY * (w.omega[i] - rate)
    for r in range(law.shape[0]):
        if is_linear(law[r]):
            continue
        for e in range(n):
            for k in range(2):
                _carry_site(w, r, e, k, before, frame.yield_angle)


@inlined
def _carry_site(w: Workspace, r: int, e: int, k: int, before: Array, limit: float) -> None:
    for j in range(memory_map.SITE):
        old = before[r, e, k, j]
        w.start[r, e, k, j] = old + _CARRY * (w.end[r, e, k, j] - old)
    dry, turn = w.start[r, e, k, memory_map.Z_DRY], w.start[r, e, k, memory_map.Z_TURN]
    axial = w.start[r, e, k, memory_map.Z_AXIAL]
    w.start[r, e, k, memory_map.Z_DRY] = min(max(dry, -limit), limit)
    size = math.sqrt(turn * turn + axial * axial)
    if size > limit:
        w.start[r, e, k, memory_map.Z_TURN] = turn * limit / size
        w.start[r, e, k, memory_map.Z_AXIAL] = axial * limit / size


@inlined
def _friction(w: Workspace, frame: Frame, drive: float, tip_torque: float) -> tuple[float, float, float]:
    """Torque of all friction on the shaft, its power, and the drive's torque.

    By balance, so that the sums hold to rounding: what inertia and torsion do not
    take of the external torques is friction.
    """
    n = w.omega.size - 1
    torque, _ = drive_torque(w, frame, drive)
    friction, power, arriving = 0.0, 0.0, torque
    for i in range(n + 1):
        leaving = -w.spring[i] * twist_of(w, i, frame.g) if i < n else tip_torque
        share = arriving - leaving - w.inertia[i] * (w.omega[i] - w.rest[i])
        friction += share
        power += share * w.omega[i]
        arriving = leaving
    return torque, friction, power


@compiled
def advance(
    head: Array,
    mesh: Array,
    law: Array,
    h: float,
    theta: Array,
    now: Array,
    nxt: Array,
    ctrl: Array,
    scratch: Array,
) -> None:
    """Advance needle and tissue by h.

    Args:
      head, mesh, law: the model's three numeric fields; law is (rows, columns).
      h: step, s.
      theta: angles of the nodes at the start, rad, (n + 1).
      now: state block at the start (sim.kernel.memory_map); MuJoCo owns its angles.
      nxt: state block that receives the end.
      ctrl: inputs at the end of the step.
      scratch: working memory (sim.kernel.memory_map.scratch).
    """
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    first = memory_map.B_ANGLES + 2 * (n + 1)
    before = now[first:].reshape(rows, n, 2, memory_map.SITE)
    w = divide(scratch, n, rows, nxt[first:].reshape(rows, n, 2, memory_map.SITE))
    past = now[memory_map.B_INPUTS : memory_map.B_INPUTS + memory_map.INPUTS]
    free = head[memory_map.H_FREE_REF] - 0.5 * (
        past[memory_map.U_CARRIAGE] + ctrl[memory_map.U_CARRIAGE]
    )
    inserted = 0.5 * (past[memory_map.U_INSERTED] + ctrl[memory_map.U_INSERTED])
    speed = 0.5 * (past[memory_map.U_SPEED] + ctrl[memory_map.U_SPEED])
    frame = Frame(
        GAMMA * h,
        speed / head[memory_map.H_RADIUS],
        head[memory_map.H_ADVECTION] * speed,
        head[memory_map.H_PRESLIDING],
        head[memory_map.H_SERVO],
        head[memory_map.H_BACKLASH],
        head[memory_map.H_DRIVE] == memory_map.DRIVE_ANGLE,
    )
    tip_loaded = past[memory_map.U_TIP] != 0.0 or ctrl[memory_map.U_TIP] != 0.0
    for r in range(rows):
        tip_loaded |= law[r, memory_map.L_POINT] * law[r, memory_map.L_TOP_INSERTED] != 0.0
    nonlinear = _prepare(head, mesh, law, theta, now, before, w, frame, free, inserted, tip_loaded)
    work, dissipated, failed, iterations = 0.0, 0.0, 0, 0
    torque, friction, stored = 0.0, 0.0, 0.0
    for stage in range(2):
        reach, share = (GAMMA, h - frame.g) if stage == 0 else (1.0, frame.g)
        drive = past[memory_map.U_DRIVE] + reach * (ctrl[memory_map.U_DRIVE] - past[memory_map.U_DRIVE])
        tip_torque = past[memory_map.U_TIP] + reach * (ctrl[memory_map.U_TIP] - past[memory_map.U_TIP])
        if stage == 1:
            _second_stage(law, theta, now, before, w, frame)
        again = stage == 1 and not nonlinear and frame.drift == 0.0
        solved, count, recoverable, stored = newton(law, w, frame, drive, tip_torque, nonlinear, again)
        torque, friction, power = _friction(w, frame, drive, tip_torque)
        shaft = (
            (ctrl[memory_map.U_DRIVE] - past[memory_map.U_DRIVE]) / h
            if frame.angle_driven
            else w.omega[0]
        )
        work += share * (torque * shaft - tip_torque * w.omega[n])
        dissipated += share * (power - recoverable)
        failed += 0 if solved else 1
        iterations += count
    for i in range(n + 1):
        nxt[memory_map.B_ANGLES + i] = w.theta[i] + frame.g * w.omega[i]
        nxt[memory_map.B_ANGLES + n + 1 + i] = w.omega[i]
    for r in range(rows):
        if is_linear(law[r]) or law[r, memory_map.L_POINT] != 0.0:
            continue
        forget_uncovered(w.loads[r], w.end[r])
        if (
            law[r, memory_map.L_STIFFNESS] > 0.0
            and speed != 0.0
            and head[memory_map.H_STRETCHING] == 0.0
        ):
            advect_tissue(h * speed, w.x, w.loads[r], w.end[r])
    for j in range(memory_map.INPUTS):
        nxt[memory_map.B_INPUTS + j] = ctrl[j]
    nxt[memory_map.O_BASE_TORQUE] = torque
    nxt[memory_map.O_BASE_ANGLE] = nxt[memory_map.B_ANGLES]
    nxt[memory_map.O_TIP_ANGLE] = nxt[memory_map.B_ANGLES + n]
    nxt[memory_map.O_FRICTION] = friction
    nxt[memory_map.O_TIP_TORQUE] = ctrl[memory_map.U_TIP]
    nxt[memory_map.O_WORK] = now[memory_map.O_WORK] + work
    nxt[memory_map.O_DISSIPATED] = now[memory_map.O_DISSIPATED] + dissipated
    nxt[memory_map.O_TISSUE_ENERGY] = stored
    nxt[memory_map.O_FAILED] = now[memory_map.O_FAILED] + failed
    nxt[memory_map.O_ITERATIONS] = iterations

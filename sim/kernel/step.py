"""One step of needle and tissue together, in implicit stages (sim.kernel.method).

A stage of length g = gamma h solves for the rates w of the nodes

    I (w - w*) / g + K (theta* + g w) + sum over sites of N f(N' w) = drive - tip,

a tridiagonal system, by Newton's method; I, K and the servo in `drive` are those of the
MuJoCo model (sim.kernel.shaft). Everything that is remembered (angles, rates, presliding,
tissue twist) is carried from stage to stage. Inputs run straight from one end of the step to
the other; lengths and speed are those of its middle.
"""

import math

from sim.kernel import memory_map
from sim.kernel.advection import advect_tissue, forget_uncovered
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.mesh import cover, place_nodes
from sim.kernel.method import CARRIED, GAMMAS, KEPT, REACH, SHARE, STAGES
from sim.kernel.shaft import Shaft, drive_input, motor_force
from sim.kernel.stage.assemble import (
    add_shaft_damping,
    add_viscous,
    hardening_energy,
    hardening_power,
    is_idle,
    is_linear,
    twist_of,
)
from sim.kernel.stage.chuck import drive_torque, slack, slipped
from sim.kernel.stage.newton import newton
from sim.kernel.stage.plasticity import carry_sets, hold_sets, keep_sets
from sim.kernel.stage.workspace import Frame, Workspace, divide
from sim.kernel.torques import set_other
from sim.kernel.view import view

_RIGID = 1e-3
"""Twist of an element beyond the tip, over that of the same element of the shaft."""


@inlined
def _prepare(
    head: Array,
    mesh: Array,
    law: Array,
    shaft: Shaft,
    theta: Array,
    rates: Array,
    before: Array,
    w: Workspace,
    frame: Frame,
    free: float,
    inserted: float,
    tip_loaded: bool,
) -> bool:
    """Fill in what the step starts from; returns whether iteration is needed."""
    springs, inertias, angles, rest, omega = w.spring, w.inertia, w.theta, w.rest, w.omega
    nominal = w.nominal
    damp_lower, damp_diagonal, damp_upper = w.damp_lower, w.damp_diagonal, w.damp_upper
    loads, point, start, end, x = w.loads, w.point, w.start, w.end, w.x
    spring, inertia = shaft.spring, shaft.inertia
    n = omega.size - 1
    place_nodes(head, mesh, free, x)
    stretching = int(head[memory_map.H_STRETCHING])
    for i in range(n):
        springs[i] = spring[i]
        if i < stretching:  # torsion falls as the length of the element grows
            springs[i] *= head[memory_map.H_FREE_REF] / free
        if head[memory_map.H_FED] != 0.0:  # beyond the tip there is no shaft that could twist
            within = (free + inserted - x[i]) / (x[i + 1] - x[i])
            springs[i] /= min(max(within, _RIGID), 1.0)
        nominal[i] = springs[i]
    for i in range(n + 1):
        inertias[i] = inertia[i] / frame.g
        angles[i] = theta[i]
        rest[i] = omega[i] = rates[i]
        damp_lower[i] = damp_diagonal[i] = damp_upper[i] = 0.0
    if head[memory_map.H_SHAFT_DAMPING] > 0.0:
        add_shaft_damping(w, head[memory_map.H_SHAFT_DAMPING])
    nonlinear = head[memory_map.H_BACKLASH] > 0.0 or frame.grip > 0.0 or frame.yield_torque > 0.0
    nonlinear |= head[memory_map.H_STIFFNESS_TORQUE] > 0.0 or frame.creep > 0.0
    nonlinear |= frame.joint > 0.0
    for r in range(law.shape[0]):
        if is_idle(law[r]):
            continue
        cover(law[r], x, free, inserted, tip_loaded, loads[r], point[r])
        if is_linear(law[r]):
            add_viscous(w, loads[r], law[r, memory_map.L_VISCOUS])
        else:
            nonlinear = True
            _hold_sites(before[r], start[r], end[r])
    return nonlinear


@inlined
def _next_stage(
    law: Array,
    theta: Array,
    rates: Array,
    before: Array,
    w: Workspace,
    frame: Frame,
    kept: float,
    carried: float,
) -> None:
    """Carry everything that is remembered into the next stage."""
    angles, omega, rest = w.theta, w.omega, w.rest
    n = omega.size - 1
    for i in range(n + 1):
        reached = angles[i] + frame.g * omega[i]
        angles[i] = theta[i] + kept * (angles[i] - theta[i]) + carried * (reached - angles[i])
        rest[i] = rates[i] + kept * (rest[i] - rates[i]) + carried * (omega[i] - rest[i])
    start, end = w.start, w.end
    for r in range(law.shape[0]):
        if not is_linear(law[r]):
            signed = law[r, memory_map.L_CONTACT] == memory_map.TURNED
            _carry_sites(before[r], start[r], end[r], frame.yield_angle, signed, kept, carried)


@embedded
def _hold_sites(before: Array, start: Array, end: Array) -> None:
    """The first stage starts from the memory of a row's sites, (n, 2, SITE) each."""
    for e in range(before.shape[0]):
        for k in range(2):
            for j in range(memory_map.SITE):
                start[e, k, j] = end[e, k, j] = before[e, k, j]


@embedded
def _carry_sites(
    before: Array, start: Array, end: Array, limit: float, signed: bool, kept: float, carried: float
) -> None:
    """The memory of a row's sites, (n, 2, SITE) each; what they have been through may have a sign."""
    for e in range(before.shape[0]):
        for k in range(2):
            for j in range(memory_map.SITE):
                first, last = before[e, k, j], start[e, k, j]
                start[e, k, j] = first + kept * (last - first) + carried * (end[e, k, j] - last)
            dry, turn = start[e, k, memory_map.Z_DRY], start[e, k, memory_map.Z_TURN]
            axial = start[e, k, memory_map.Z_AXIAL]
            start[e, k, memory_map.Z_DRY] = min(max(dry, -limit), limit)
            if not signed:
                start[e, k, memory_map.PAST] = max(start[e, k, memory_map.PAST], 0.0)
            size = math.sqrt(turn * turn + axial * axial)
            if size > limit:
                start[e, k, memory_map.Z_TURN] = turn * limit / size
                start[e, k, memory_map.Z_AXIAL] = axial * limit / size


@inlined
def _friction(
    w: Workspace,
    frame: Frame,
    drive: float,
    slip: float,
    tip_torque: float,
    weight: float,
    tissue: Array,
) -> tuple[float, float, float]:
    """Torque of all friction on the shaft, its power, and the drive's torque.

    By balance, so that the sums hold to rounding: what inertia and torsion do not
    take of the external torques is friction. `tissue` gains what it does to every node,
    times the weight of the stage.
    """
    theta, omega, rest, spring, inertia = w.theta, w.omega, w.rest, w.spring, w.inertia
    n = omega.size - 1
    torque, _ = drive_torque(w, frame, drive, slip)
    friction, power, arriving = 0.0, 0.0, torque
    for i in range(n + 1):
        leaving = tip_torque
        if i < n:
            leaving = -spring[i] * (twist_of(theta, omega, i, frame.g) - w.set[i])
        share = arriving - leaving - inertia[i] * (omega[i] - rest[i])
        friction += share
        power += share * omega[i]
        tissue[i] -= weight * share
        arriving = leaving
    return torque, friction, power


@embedded
def advance(
    head: Array,
    mesh: Array,
    law: Array,
    shaft: Shaft,
    h: float,
    theta: Array,
    rates: Array,
    now: Array,
    nxt: Array,
    ctrl: Array,
    torques: Array,
    scratch: Array,
) -> None:
    """Advance needle and tissue by h.

    Args:
      head, mesh, law: the model's numeric fields; law is (rows, columns).
      shaft: the model's needle.
      h: step, s.
      theta, rates: of the nodes at the start, rad and rad/s, (n + 1).
      now: state block at the start (sim.kernel.memory_map); MuJoCo owns its angles.
      nxt: state block that receives the end.
      ctrl: inputs at the end of the step.
      torques: (TORQUES, n + 1), receives tissue, per node, and other, per joint.
      scratch: working memory (sim.kernel.stage.workspace).
    """
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    first = memory_map.B_ANGLES + 3 * n + 2
    sites = (rows, n, 2, memory_map.SITE)
    before = view(now, first, sites)
    w = divide(scratch, n, rows, view(nxt, first, sites))
    sets, sets_after = view(now, first - n, (n,)), view(nxt, first - n, (n,))
    past = view(now, memory_map.B_INPUTS, (memory_map.INPUTS,))
    free = head[memory_map.H_FREE_REF] - 0.5 * (
        past[memory_map.U_CARRIAGE] + ctrl[memory_map.U_CARRIAGE]
    )
    inserted = 0.5 * (past[memory_map.U_INSERTED] + ctrl[memory_map.U_INSERTED])
    speed = 0.5 * (past[memory_map.U_SPEED] + ctrl[memory_map.U_SPEED])
    order = int(head[memory_map.H_ORDER])
    stages = STAGES[order - 1]
    frame = Frame(
        GAMMAS[order - 1] * h,
        speed / head[memory_map.H_RADIUS],
        head[memory_map.H_ADVECTION] * speed,
        head[memory_map.H_PRESLIDING],
        shaft.servo,
        head[memory_map.H_BACKLASH],
        1.0 + 0.5 * (past[memory_map.U_TISSUE] + ctrl[memory_map.U_TISSUE]),
        head[memory_map.H_GRIP] if shaft.servo > 0.0 else 0.0,
        head[memory_map.H_YIELD],
        head[memory_map.H_YIELD_SLOPE],
        head[memory_map.H_CREEP],
        head[memory_map.H_CREEP_TIME],
        head[memory_map.H_STOP],
        head[memory_map.H_SPRING],
        head[memory_map.H_JOINT],
        head[memory_map.H_JOINT_AT],
    )
    drive_was, drive_is = (
        drive_input(shaft, past[memory_map.U_DRIVE]),
        drive_input(shaft, ctrl[memory_map.U_DRIVE]),
    )
    tip_was, tip_is = (
        -motor_force(shaft.tip, past[memory_map.U_TIP]),
        -motor_force(shaft.tip, ctrl[memory_map.U_TIP]),
    )
    tip_loaded = tip_was != 0.0 or tip_is != 0.0
    for r in range(rows):
        tip_loaded |= law[r, memory_map.L_POINT] * law[r, memory_map.L_TOP_INSERTED] != 0.0
    nonlinear = _prepare(
        head, mesh, law, shaft, theta, rates, before, w, frame, free, inserted, tip_loaded
    )
    hold_sets(w, sets)
    tissue = torques[memory_map.T_TISSUE]
    for i in range(n + 1):
        tissue[i] = 0.0
    work, dissipated, failed, iterations = 0.0, 0.0, 0, 0
    torque, friction, stored, drive = 0.0, 0.0, 0.0, 0.0
    slip_was = slip_from = slip = now[memory_map.O_CHUCK_SLIP]
    for stage in range(order):
        reach, share = stages[stage, REACH], stages[stage, SHARE]
        drive = drive_was + reach * (drive_is - drive_was)
        tip_torque = tip_was + reach * (tip_is - tip_was)
        if stage > 0:
            kept, carried = stages[stage - 1, KEPT], stages[stage - 1, CARRIED]
            _next_stage(law, theta, rates, before, w, frame, kept, carried)
            slip_from = slip_was + kept * (slip_from - slip_was) + carried * (slip - slip_from)
            slip_from = slack(slip_from, frame.stop)
            carry_sets(w, sets, kept, carried)
        again = stage > 0 and not nonlinear and frame.drift == 0.0
        solved, count, recoverable, stored = newton(
            head, law, w, frame, drive - slip_from, tip_torque, nonlinear, again, slip_from
        )
        for r in range(rows):
            recoverable += hardening_power(w, r, law[r], frame)
        torque, friction, power = _friction(
            w, frame, drive - slip_from, slip_from, tip_torque, share, tissue
        )
        slip = slip_from + slipped(w, frame, drive - slip_from, torque, slip_from)
        turning = (drive_is - drive_was) / h if shaft.servo > 0.0 else w.omega[0]
        work += h * share * (torque * turning - tip_torque * w.omega[n])
        dissipated += h * share * (power - recoverable)
        failed += 0 if solved else 1
        iterations += count
    end = view(nxt, memory_map.B_ANGLES, (n + 1,))
    for i in range(n + 1):
        end[i] = w.theta[i] + frame.g * w.omega[i]
        nxt[memory_map.B_ANGLES + n + 1 + i] = w.omega[i]
    heat, kept_energy = keep_sets(w, frame, h, sets, sets_after)
    for r in range(rows):
        if is_linear(law[r]) or law[r, memory_map.L_POINT] != 0.0:
            continue
        stored += hardening_energy(w, r, law[r], frame)
        forget_uncovered(w.loads[r], w.end[r])
        if (
            law[r, memory_map.L_STIFFNESS] > 0.0
            and speed != 0.0
            and head[memory_map.H_STRETCHING] == 0.0
            and head[memory_map.H_FED] == 0.0
        ):
            advect_tissue(h * speed, w.x, w.loads[r], w.end[r], w.places, w.twist)
    chain = head[memory_map.H_CHAIN] != 0.0
    taken_up = slip + slack(drive - slip - end[0], frame.backlash)
    set_other(chain, shaft, w.spring, w.set, taken_up, end, torques[memory_map.T_OTHER])
    for j in range(memory_map.INPUTS):
        nxt[memory_map.B_INPUTS + j] = ctrl[j]
    nxt[memory_map.O_BASE_TORQUE] = torque
    nxt[memory_map.O_BASE_ANGLE] = end[0]
    nxt[memory_map.O_TIP_ANGLE] = end[n]
    nxt[memory_map.O_FRICTION] = friction
    nxt[memory_map.O_TIP_TORQUE] = tip_is
    nxt[memory_map.O_WORK] = now[memory_map.O_WORK] + work
    dissipated += heat + frame.grip * abs(slip - slip_was)
    nxt[memory_map.O_CHUCK_SLIP] = slip
    nxt[memory_map.O_DISSIPATED] = now[memory_map.O_DISSIPATED] + dissipated
    nxt[memory_map.O_TISSUE_ENERGY] = stored
    nxt[memory_map.O_FAILED] = now[memory_map.O_FAILED] + failed
    nxt[memory_map.O_ITERATIONS] = iterations
    _show_shaft(w, end, nxt)
    nxt[memory_map.O_SHAFT_ENERGY] += kept_energy + 0.5 * frame.spring * slip * slip


@inlined
def _show_shaft(w: Workspace, end: Array, nxt: Array) -> None:
    """Energy that the shaft stores, and the largest torque that one of its elements carries."""
    spring = w.spring
    energy, largest = 0.0, 0.0
    for e in range(end.size - 1):
        twist = end[e + 1] - end[e] - w.set[e]
        energy += 0.5 * spring[e] * twist * twist
        largest = max(largest, abs(spring[e] * twist))
    nxt[memory_map.O_SHAFT_ENERGY] = energy
    nxt[memory_map.O_SHAFT_TORQUE] = largest

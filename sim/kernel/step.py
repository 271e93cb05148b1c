"""One step of needle and tissue together, in implicit stages (sim.kernel.method).

A stage of length g = gamma h solves for the rates w of the nodes

    I (w - w*) / g + K (theta* + g w) + sum over sites of N f(N' w) = drive - tip,

a tridiagonal system, by Newton's method; I, K and the servo in `drive` are those of the
MuJoCo model (sim.kernel.shaft). Everything that is remembered (angles, rates, presliding,
tissue twist) is carried from stage to stage. Inputs run straight from one end of the step to
the other; lengths and speed are those of its middle.
"""

from typing import Any, NamedTuple

from numba import njit

from sim.kernel import memory_map
from sim.kernel.advection import advect_tissue, forget_uncovered
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.method import CARRIED, GAMMAS, KEPT, REACH, SHARE, STAGES
from sim.kernel.shaft import Shaft
from sim.kernel.stage.assemble import hardening_energy, hardening_power, is_linear
from sim.kernel.stage.balance import friction, stored_in_shaft
from sim.kernel.stage.beginning import begin
from sim.kernel.stage.carry import next_stage
from sim.kernel.stage.chuck import drive_torque, slack, slipped, taken_up
from sim.kernel.stage.inputs import Inputs, inputs_of
from sim.kernel.stage.newton import newton
from sim.kernel.stage.plasticity import carry_sets, hold_sets, keep_sets
from sim.kernel.stage.workspace import Frame, Workspace, divide, frame_of
from sim.kernel.torques import set_other
from sim.kernel.view import view

_sets_at: Any = njit(memory_map.sets_at)
_sites_at: Any = njit(memory_map.sites_at)


class Done(NamedTuple):
    """What the stages of a step have done; last values are those of the last stage."""

    work: float  # done by the drive, J
    dissipated: float  # by friction, J
    failed: int  # stages whose iteration did not converge
    iterations: int
    torque: float  # last of the drive, N m
    friction: float  # last of all friction, N m
    stored: float  # last energy in the tissue, J
    ahead: float  # angle from the needle's slip in the chuck to the drive, rad
    slip: float  # of the needle in the chuck, rad


@inlined
def _run_stages(
    head: Array,
    law: Array,
    theta: Array,
    rates: Array,
    before: Array,
    sets: Array,
    w: Workspace,
    frame: Frame,
    inputs: Inputs,
    h: float,
    slip_was: float,
    nonlinear: bool,
    tissue: Array,
) -> Done:
    """Solve one stage after the other; `tissue` gains what tissue does to the nodes, N m."""
    order = int(head[memory_map.H_ORDER])
    stages = STAGES[order - 1]
    n = w.omega.size - 1
    work, dissipated, failed, iterations = 0.0, 0.0, 0, 0
    torque, all_friction, stored, drive = 0.0, 0.0, 0.0, 0.0
    slip_from = slip = slip_was
    for stage in range(order):
        reach, share = stages[stage, REACH], stages[stage, SHARE]
        drive = inputs.drive_was + reach * (inputs.drive_is - inputs.drive_was)
        tip_torque = inputs.tip_was + reach * (inputs.tip_is - inputs.tip_was)
        if stage > 0:
            kept, carried = stages[stage - 1, KEPT], stages[stage - 1, CARRIED]
            next_stage(law, theta, rates, before, w, frame, kept, carried)
            slip_from = slip_was + kept * (slip_from - slip_was) + carried * (slip - slip_from)
            slip_from = slack(slip_from, frame.stop)
            carry_sets(w, sets, kept, carried)
        again = stage > 0 and not nonlinear and frame.drift == 0.0
        solved, count, recoverable, stored = newton(
            head, law, w, frame, drive - slip_from, tip_torque, nonlinear, again, slip_from
        )
        for r in range(law.shape[0]):
            recoverable += hardening_power(w, r, law[r], frame)
        torque, _ = drive_torque(w, frame, drive - slip_from, slip_from)
        all_friction, power = friction(w, frame, torque, tip_torque, share, tissue)
        slip = slip_from + slipped(w, frame, drive - slip_from, torque, slip_from)
        turning = (inputs.drive_is - inputs.drive_was) / h if frame.servo > 0.0 else w.omega[0]
        work += h * share * (torque * turning - tip_torque * w.omega[n])
        dissipated += h * share * (power - recoverable)
        failed += 0 if solved else 1
        iterations += count
    return Done(work, dissipated, failed, iterations, torque, all_friction, stored, drive - slip, slip)


@inlined
def _keep_tissue(head: Array, law: Array, w: Workspace, frame: Frame, inputs: Inputs, h: float) -> float:
    """Move the tissue's twist along the shaft; returns what hardening has stored in it, J."""
    stored = 0.0
    mesh_stands_still = head[memory_map.H_STRETCHING] != 0.0 or head[memory_map.H_FED] != 0.0
    for r in range(law.shape[0]):
        if is_linear(law[r]) or law[r, memory_map.L_POINT] != 0.0:
            continue
        stored += hardening_energy(w, r, law[r], frame)
        forget_uncovered(w.loads[r], w.end[r])
        if law[r, memory_map.L_STIFFNESS] == 0.0:
            continue
        dragged = law[r, memory_map.L_DRAGGED]
        share = dragged if mesh_stands_still else 1.0 - dragged
        if share > 0.0 and inputs.speed != 0.0:
            moved = h * inputs.speed * (-1.0 if mesh_stands_still else 1.0)
            advect_tissue(moved, share, w.x, w.loads[r], w.end[r], w.places, w.twist, mesh_stands_still)
    return stored


@inlined
def _write(
    w: Workspace, frame: Frame, inputs: Inputs, done: Done, heat: float, now: Array, nxt: Array
) -> None:
    """What the sensors show at the end of the step, from the last values and the running sums."""
    n = w.omega.size - 1
    end = view(nxt, memory_map.B_ANGLES, (n + 1,))
    nxt[memory_map.O_BASE_TORQUE] = done.torque
    nxt[memory_map.O_BASE_ANGLE] = end[0]
    nxt[memory_map.O_TIP_ANGLE] = end[n]
    nxt[memory_map.O_FRICTION] = done.friction
    nxt[memory_map.O_TIP_TORQUE] = inputs.tip_is
    nxt[memory_map.O_WORK] = now[memory_map.O_WORK] + done.work
    slip_was = now[memory_map.O_CHUCK_SLIP]
    dissipated = done.dissipated + (heat + frame.grip * abs(done.slip - slip_was))
    nxt[memory_map.O_CHUCK_SLIP] = done.slip
    nxt[memory_map.O_DISSIPATED] = now[memory_map.O_DISSIPATED] + dissipated
    nxt[memory_map.O_FAILED] = now[memory_map.O_FAILED] + done.failed
    nxt[memory_map.O_ITERATIONS] = done.iterations


@embedded
def advance(
    head: Array,
    mesh: Array,
    law: Array,
    shaft: Shaft,
    time: float,
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
      time, h: start and length of the step, s.
      theta, rates: of the nodes at the start, rad and rad/s, (n + 1).
      now: state block at the start (sim.kernel.memory_map); MuJoCo owns its angles.
      nxt: state block that receives the end.
      ctrl: inputs at the end of the step.
      torques: (TORQUES, n + 1), receives tissue, per node, and other, per joint.
      scratch: working memory (sim.kernel.stage.workspace).
    """
    n, rows = int(head[memory_map.H_ELEMENTS]), int(head[memory_map.H_ROWS])
    at, sites = _sites_at(n), (rows, n, 2, memory_map.SITE)
    before = view(now, at, sites)
    w = divide(scratch, n, rows, view(nxt, at, sites))
    sets, sets_after = view(now, _sets_at(n), (n,)), view(nxt, _sets_at(n), (n,))
    past = view(now, memory_map.B_INPUTS, (memory_map.INPUTS,))
    inputs = inputs_of(head, law, shaft, past, ctrl)
    g = GAMMAS[int(head[memory_map.H_ORDER]) - 1] * h
    frame = frame_of(head, shaft, g, inputs, time + h)
    nonlinear = begin(head, mesh, law, shaft, theta, rates, before, w, frame, inputs)
    hold_sets(w, sets)
    tissue = torques[memory_map.T_TISSUE]
    for i in range(n + 1):
        tissue[i] = 0.0
    slip_was = now[memory_map.O_CHUCK_SLIP]
    done = _run_stages(
        head, law, theta, rates, before, sets, w, frame, inputs, h, slip_was, nonlinear, tissue
    )
    end = view(nxt, memory_map.B_ANGLES, (n + 1,))
    for i in range(n + 1):
        end[i] = w.theta[i] + frame.g * w.omega[i]
        nxt[memory_map.B_ANGLES + n + 1 + i] = w.omega[i]
    for j in range(memory_map.INPUTS):
        nxt[memory_map.B_INPUTS + j] = ctrl[j]
    heat, kept_energy = keep_sets(w, frame, h, sets, sets_after)
    nxt[memory_map.O_TISSUE_ENERGY] = done.stored + _keep_tissue(head, law, w, frame, inputs, h)
    unfelt = done.slip + taken_up(done.ahead - end[0], frame)
    chain = head[memory_map.H_CHAIN] != 0.0
    set_other(chain, shaft, w.spring, w.set, unfelt, end, torques[memory_map.T_OTHER])
    _write(w, frame, inputs, done, heat, now, nxt)
    energy, largest = stored_in_shaft(w, end)
    spring_energy = 0.5 * frame.spring * done.slip * done.slip
    nxt[memory_map.O_SHAFT_ENERGY] = energy + (kept_energy + spring_energy)
    nxt[memory_map.O_SHAFT_TORQUE] = largest

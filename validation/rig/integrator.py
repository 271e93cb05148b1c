"""Integration in time: BDF2 with variable steps; a step is halved if Newton's method fails.

A trial starts untwisted and at rest, in the middle of the chuck's play. The inputs are linear between
the points of the time grid. Coefficients: Hairer, Norsett and Wanner,
Solving Ordinary Differential Equations I, III.5.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.laws.parameters import LawParameters
from validation.rig.laws.shaft import chuck_torque
from validation.rig.memory import commit, interpolate_to_nodes, tissue_point_count
from validation.rig.mesh import CellChain, MeshSize, assemble, empty_chain
from validation.rig.newton import solve
from validation.rig.state import NewtonWorkspace, RigState, StepInput, initial_state, workspace

Array = NDArray[np.float64]

SMALLEST_PART = 1.0 / 256.0
BASE, INSERTED, FREE, SPEED, TIP_TORQUE, TIME = 0, 1, 2, 3, 4, 5


@njit(cache=True)
def integrate(law: LawParameters, mesh: MeshSize, dt: float, drive: Array) -> tuple[Array, Array, int]:
    """Simulate a trial.

    Args:
      dt: distance of the points of the time grid, s.
      drive: (6, N) base angle, inserted and free length, axial speed, tip torque, time.

    Returns:
      Tip angle (N,), rad; drive torque (N,), N mm; index of the time at which no balance
      of torques was found (-1: none).
    """
    count = drive.shape[1]
    total = drive[INSERTED, 0] + drive[FREE, 0]
    state = initial_state(
        mesh.nodes, tissue_point_count(mesh, total, drive[INSERTED].max()), drive[BASE, 0]
    )
    work, chain = workspace(mesh.nodes), empty_chain(mesh.nodes)
    tip, torque = np.empty(count), np.empty(count)
    assemble(chain, law, mesh, drive[FREE, 0], drive[FREE, 0], drive[INSERTED, 0])
    tip[0] = state.angle[-1]
    torque[0] = chuck_torque(law, chain, state, drive[BASE, 0], state.angle[0])[0]
    last_step = 0.0
    for k in range(1, count):
        done, part = 0.0, 1.0
        while done < 1.0:
            start = drive[:, k - 1] + done * (drive[:, k] - drive[:, k - 1])
            end = drive[:, k - 1] + (done + part) * (drive[:, k] - drive[:, k - 1])
            if _advance(law, mesh, chain, state, work, start, end, (part * dt, last_step)):
                done, last_step = done + part, part * dt
            elif part <= SMALLEST_PART:
                return tip, torque, k
            else:
                part /= 2.0
        tip[k] = state.angle[-1]
        torque[k] = chuck_torque(law, chain, state, drive[BASE, k], state.angle[0])[0]
    return tip, torque, -1


@njit(cache=True)
def _advance(
    law: LawParameters,
    mesh: MeshSize,
    chain: CellChain,
    state: RigState,
    work: NewtonWorkspace,
    start: Array,
    end: Array,
    steps: tuple[float, float],
) -> bool:
    """Take one step; the state is unchanged if no balance is found.

    Args:
      start, end: inputs at both ends of the step, (6,).
      steps: this step and the last one, s.
    """
    step, last = steps
    assemble(chain, law, mesh, end[FREE], 0.5 * (start[FREE] + end[FREE]), end[INSERTED])
    lead, now, older = _weights(step, last)
    rate = 1.0 / last if last > 0.0 else 0.0
    for i in range(mesh.nodes):
        work.angle_past[i] = older * state.angle_before[i] - now * state.angle[i]
        work.angle[i] = state.angle[i] + step * rate * (state.angle[i] - state.angle_before[i])
    tissue_past = older * state.tissue_twist_before - now * state.tissue_twist
    interpolate_to_nodes(mesh, chain, state.tissue_twist, work.twist_now)
    interpolate_to_nodes(mesh, chain, tissue_past, work.twist_past)
    work.twist[:] = work.twist_now
    speed = 0.5 * (start[SPEED] + end[SPEED])
    travel = speed * step / law.radius
    inputs = StepInput(end[BASE], end[TIP_TORQUE], lead, travel, end[TIME], speed)
    if not solve(law, chain, state, inputs, work):
        return False
    commit(law, mesh, chain, state, work, inputs, tissue_past, (step, end[INSERTED]))
    return True


@njit(cache=True)
def _weights(step: float, last: float) -> tuple[float, float, float]:
    """Coefficients of the new, the last and the older value in a rate: BDF2, or backward Euler."""
    if last == 0.0 or step > 2.0 * last:
        return 1.0 / step, 1.0 / step, 0.0
    ratio = step / last
    return (
        (1.0 + 2.0 * ratio) / (1.0 + ratio) / step,
        (1.0 + ratio) / step,
        ratio * ratio / (1.0 + ratio) / step,
    )

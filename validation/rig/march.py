"""The march in time: BDF2 with steps that are halved where no balance is found.

A trial starts untwisted and at rest, in the middle of the chuck's play. What drives the rig is linear
between the points of the time grid.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.balance import chuck
from validation.rig.laws import Law
from validation.rig.memory import commit, places_of, seen_by_nodes
from validation.rig.mesh import Layout, Mesh, empty_layout, lay_out
from validation.rig.newton import solve
from validation.rig.state import Push, State, Work, at_rest, space

Array = NDArray[np.float64]

SMALLEST_PART = 1.0 / 256.0
BASE, INSERTED, FREE, SPEED, TIP_TORQUE = 0, 1, 2, 3, 4


@njit(cache=True)
def march(law: Law, mesh: Mesh, dt: float, drive: Array) -> tuple[Array, Array, int]:
    """Replay a trial.

    Args:
      dt: distance of the points of the time grid, s.
      drive: (5, N) base angle, inserted and free length, axial speed, tip torque.

    Returns:
      Tip angle (N,), rad; drive torque (N,), N mm; where no balance was found (-1: nowhere).
    """
    count = drive.shape[1]
    total = drive[INSERTED, 0] + drive[FREE, 0]
    state = at_rest(mesh.nodes, places_of(mesh, total, drive[INSERTED].max()), drive[BASE, 0])
    work, lay = space(mesh.nodes), empty_layout(mesh.nodes)
    tip, torque = np.empty(count), np.empty(count)
    lay_out(lay, law, mesh, drive[FREE, 0], drive[FREE, 0], drive[INSERTED, 0])
    tip[0] = state.angle[-1]
    torque[0] = chuck(law, lay, state, drive[BASE, 0], state.angle[0])[0]
    last_step = 0.0
    for k in range(1, count):
        done, part = 0.0, 1.0
        while done < 1.0:
            lag = drive[:, k - 1] + done * (drive[:, k] - drive[:, k - 1])
            end = drive[:, k - 1] + (done + part) * (drive[:, k] - drive[:, k - 1])
            if _advance(law, mesh, lay, state, work, lag, end, (part * dt, last_step)):
                done, last_step = done + part, part * dt
            elif part <= SMALLEST_PART:
                return tip, torque, k
            else:
                part /= 2.0
        tip[k] = state.angle[-1]
        torque[k] = chuck(law, lay, state, drive[BASE, k], state.angle[0])[0]
    return tip, torque, -1


@njit(cache=True)
def _advance(
    law: Law,
    mesh: Mesh,
    lay: Layout,
    state: State,
    work: Work,
    lag: Array,
    end: Array,
    steps: tuple[float, float],
) -> bool:
    """One step; the state is untouched if no balance is found. `steps`: this one and the last, s."""
    step, last = steps
    lay_out(lay, law, mesh, end[FREE], 0.5 * (lag[FREE] + end[FREE]), end[INSERTED])
    lead, now, older = _weights(step, last)
    rate = 1.0 / last if last > 0.0 else 0.0
    for i in range(mesh.nodes):
        work.angle_past[i] = older * state.angle_before[i] - now * state.angle[i]
        work.angle[i] = state.angle[i] + step * rate * (state.angle[i] - state.angle_before[i])
    past = older * state.places_before - now * state.places
    seen_by_nodes(mesh, lay, state.places, work.twist_now)
    seen_by_nodes(mesh, lay, past, work.twist_past)
    work.twist[:] = work.twist_now
    travel = 0.5 * (lag[SPEED] + end[SPEED]) * step / law.radius
    push = Push(end[BASE], end[TIP_TORQUE], lead, travel)
    if not solve(law, lay, state, push, work):
        return False
    commit(law, mesh, lay, state, work, push, past, (step, end[INSERTED]))
    return True


@njit(cache=True)
def _weights(step: float, last: float) -> tuple[float, float, float]:
    """Of the new, the last and the older value in a rate: BDF2, or backward Euler."""
    if last == 0.0 or step > 2.0 * last:
        return 1.0 / step, 1.0 / step, 0.0
    ratio = step / last
    return (
        (1.0 + 2.0 * ratio) / (1.0 + ratio) / step,
        (1.0 + ratio) / step,
        ratio * ratio / (1.0 + ratio) / step,
    )

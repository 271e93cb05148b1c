"""What is remembered after a step: presliding, age and wear of nodes, twist of places in the tissue.

The twist belongs to places: the nodes themselves if the mesh is fixed in the tissue, else a finer grid
that the needle passes. Each place feels the torque of the shaft that is there; bare tissue creeps back.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.balance import chuck, passed
from validation.rig.laws import Law, preslide, preslide_shared
from validation.rig.mesh import Layout, Mesh
from validation.rig.state import CHUCK, ENTRY, TIP, Push, State, Work

Array = NDArray[np.float64]

PLACES_PER_CELL = 4


@njit(cache=True)
def places_of(mesh: Mesh, total: float, deepest: float) -> int:
    """How many places in the tissue the needle of that length reaches."""
    if not mesh.growing:
        return mesh.nodes
    return int(np.ceil(deepest / total * (mesh.nodes - 1) * PLACES_PER_CELL)) + 2


@njit(cache=True)
def seen_by_nodes(mesh: Mesh, lay: Layout, places: Array, nodes: Array) -> None:
    """Write the values of places at the depths of the nodes."""
    if not mesh.growing:
        nodes[:] = places
        return
    place = lay.link_mm[1] / PLACES_PER_CELL
    for i in range(mesh.nodes):
        at = min(max(lay.depth[i] / place - 0.5, 0.0), places.size - 1.001)
        below = int(at)
        nodes[i] = places[below] + (at - below) * (places[below + 1] - places[below])


@njit(cache=True)
def commit(
    law: Law,
    mesh: Mesh,
    lay: Layout,
    state: State,
    work: Work,
    push: Push,
    past: Array,
    step_and_depth: tuple[float, float],
) -> None:
    """Make the solution in `work` the state; `past`: what the rates of places remember."""
    state.lumped[ENTRY] = preslide(law.limit, state.lumped[ENTRY], passed(lay, state, work))[0]
    tip_turn = work.angle[-1] - state.angle[-1]
    state.lumped[TIP] = preslide(law.limit, state.lumped[TIP], tip_turn)[0]
    state.lumped[CHUCK] += chuck(law, lay, state, push.base, work.angle[0])[2]
    for i in range(mesh.nodes):
        _remember(law, lay, state, work, push, i, step_and_depth[0])
    _twist_places(law, mesh, lay, state, work, push, past, step_and_depth[1])
    state.angle_before[:] = state.angle
    state.angle[:] = work.angle


@njit(cache=True)
def _remember(law: Law, lay: Layout, state: State, work: Work, push: Push, i: int, step: float) -> None:
    """Presliding, age and travelled angle of one node."""
    turn = work.angle[i] - state.angle[i]
    slip = turn - work.twist[i] + work.twist_now[i]
    state.sheath[i] = preslide(law.limit, state.sheath[i], turn)[0] if lay.sheath[i] > 0.0 else 0.0
    if lay.tissue[i] == 0.0:
        state.presliding[i] = state.turning[i] = state.axial[i] = 0.0
        return
    shared = preslide_shared(law.limit, state.turning[i] + slip, state.axial[i] + push.axial_travel)
    state.turning[i], state.axial[i] = shared[0], shared[1]
    state.presliding[i] = preslide(law.limit, state.presliding[i], slip)[0]
    state.worn[i] += abs(slip)
    state.age[i] = (state.age[i] + step) / (1.0 + abs(slip) / law.ageing_angle)


@njit(cache=True)
def _twist_places(
    law: Law,
    mesh: Mesh,
    lay: Layout,
    state: State,
    work: Work,
    push: Push,
    past: Array,
    inserted: float,
) -> None:
    if not mesh.growing:
        state.places_before[:] = state.places
        state.places[:] = work.twist
        return
    slowing = 1.0 + law.retardation * push.lead
    place = lay.link_mm[1] / PLACES_PER_CELL
    touched = lay.tissue > 0.0
    depths = (np.arange(state.places.size) + 0.5) * place
    torque = np.interp(depths, lay.depth[touched], work.torque[touched])
    state.places_before[:] = state.places
    for i in range(state.places.size):
        share = min(max((inserted - depths[i]) / place + 0.5, 0.0), 1.0)
        state.places[i] = (law.softness * share * torque[i] - law.retardation * past[i]) / slowing

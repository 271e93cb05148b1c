"""Internal variables after a step: presliding, age and wear of nodes, set of links, twist of the tissue.

The twist belongs to points of the tissue: the nodes themselves in an Eulerian mesh, else a finer grid
through which the needle slides. Each point carries the torque of the shaft at its place; tissue without
needle creeps back.
"""

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.balance import entry_turn
from validation.rig.laws.interface import preslide, preslide_shared
from validation.rig.laws.parameters import LawParameters
from validation.rig.laws.shaft import chuck_torque, set_growth
from validation.rig.laws.tissue import hardening_twist, tissue_compliance
from validation.rig.mesh import CellChain, MeshSize
from validation.rig.state import CHUCK, ENTRY, TIP, NewtonWorkspace, RigState, StepInput

Array = NDArray[np.float64]

POINTS_PER_CELL = 4


@njit(cache=True)
def tissue_point_count(mesh: MeshSize, total: float, deepest: float) -> int:
    """Number of points of the tissue that a needle of that total length can reach; lengths in mm."""
    if not mesh.lagrangian:
        return mesh.nodes
    return int(np.ceil(deepest / total * (mesh.nodes - 1) * POINTS_PER_CELL)) + 2


@njit(cache=True)
def interpolate_to_nodes(mesh: MeshSize, chain: CellChain, points: Array, nodes: Array) -> None:
    """Write the values at points of the tissue to the depths of the nodes, linearly interpolated."""
    if not mesh.lagrangian:
        nodes[:] = points
        return
    spacing = chain.link_mm[1] / POINTS_PER_CELL
    for i in range(mesh.nodes):
        at = min(max(chain.depth[i] / spacing - 0.5, 0.0), points.size - 1.001)
        below = int(at)
        nodes[i] = points[below] + (at - below) * (points[below + 1] - points[below])


@njit(cache=True)
def commit(
    law: LawParameters,
    mesh: MeshSize,
    chain: CellChain,
    state: RigState,
    work: NewtonWorkspace,
    inputs: StepInput,
    tissue_past: Array,
    step_and_depth: tuple[float, float],
) -> None:
    """Write the solution in `work` into the state.

    Args:
      tissue_past: past part of the rates of the tissue's twist, (points,).
      step_and_depth: s, mm.
    """
    state.lumped[ENTRY] = preslide(law.limit, state.lumped[ENTRY], entry_turn(chain, state, work))[0]
    tip_turn = work.angle[-1] - state.angle[-1]
    state.lumped[TIP] = preslide(law.limit, state.lumped[TIP], tip_turn)[0]
    state.lumped[CHUCK] += chuck_torque(law, chain, state, inputs.base, work.angle[0])[2]
    for i in range(mesh.nodes):
        before = inputs.base - state.lumped[CHUCK] if i == 0 else work.angle[i - 1]
        twist = before - work.angle[i]
        state.set_twist[i] += set_growth(law, chain.link[i], twist, state.set_twist[i])
        _remember(law, chain, state, work, inputs, i, step_and_depth[0])
    _twist_tissue(law, mesh, chain, state, work, inputs, tissue_past, step_and_depth[1])
    state.angle_before[:] = state.angle
    state.angle[:] = work.angle


@njit(cache=True)
def _remember(
    law: LawParameters,
    chain: CellChain,
    state: RigState,
    work: NewtonWorkspace,
    inputs: StepInput,
    i: int,
    step: float,
) -> None:
    """Presliding, age and travelled angle of one node."""
    turn = work.angle[i] - state.angle[i]
    slip = turn - work.twist[i] + work.twist_now[i]
    state.sheath[i] = preslide(law.limit, state.sheath[i], turn)[0] if chain.sheath[i] > 0.0 else 0.0
    if chain.tissue[i] == 0.0:
        state.presliding[i] = state.turning[i] = state.axial[i] = 0.0
        return
    shared = preslide_shared(law.limit, state.turning[i] + slip, state.axial[i] + inputs.axial_travel)
    state.turning[i], state.axial[i] = shared[0], shared[1]
    state.presliding[i] = preslide(law.limit, state.presliding[i], slip)[0]
    state.worn[i] += abs(slip)
    state.age[i] = (state.age[i] + step) / (1.0 + abs(slip) / law.ageing_angle)


@njit(cache=True)
def _twist_tissue(
    law: LawParameters,
    mesh: MeshSize,
    chain: CellChain,
    state: RigState,
    work: NewtonWorkspace,
    inputs: StepInput,
    tissue_past: Array,
    inserted: float,
) -> None:
    if not mesh.lagrangian:
        state.tissue_twist_before[:] = state.tissue_twist
        state.tissue_twist[:] = work.twist
        return
    retarded = 1.0 + law.retardation * inputs.lead
    spacing = chain.link_mm[1] / POINTS_PER_CELL
    touched = chain.tissue > 0.0
    depths = (np.arange(state.tissue_twist.size) + 0.5) * spacing
    torque = np.interp(depths, chain.depth[touched], work.torque[touched])
    state.tissue_twist_before[:] = state.tissue_twist
    for i in range(state.tissue_twist.size):
        share = min(max((inserted - depths[i]) / spacing + 0.5, 0.0), 1.0)
        compliance = tissue_compliance(law, inputs.time, depths[i])
        forced = compliance * share * torque[i] - law.retardation * tissue_past[i]
        state.tissue_twist[i] = hardening_twist(law.tissue_hardening, retarded, forced)

"""The chain of finite volumes at one time: the places of its nodes, and the coefficients at each.

At constant inserted length the mesh is Eulerian, fixed in the tissue: free cells (if a sheath rubs), the
entry, inserted cells, the tip. If the inserted length changes, the mesh is Lagrangian, fixed to the
needle: cells from chuck to tip, each in the tissue with the share of it that lies beyond the entry, and
the tip. Cells carry friction and have their node in the middle; entry and tip are nodes without length.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.laws.parameters import LawParameters

Array = NDArray[np.float64]


class MeshSize(NamedTuple):
    """Numbers of cells, and the frame of the mesh.

    Attributes:
      free_cells: cells of the free shaft in an Eulerian mesh; 0 without a sheath.
      lagrangian: fixed to the needle instead of the tissue.
    """

    nodes: int
    free_cells: int
    lagrangian: bool


class CellChain(NamedTuple):
    """Geometry and coefficients per node, (nodes,); link i joins node i to the one before it.

    Attributes:
      link_mm, link: length and torsional stiffness (N mm/rad) of the links; `link` has one more entry,
        0, for what lies behind the tip.
      depth: depth of the part that is in the tissue, mm.
      tissue, sheath: length in the tissue and in the sheath, mm.
      damping: viscous torque per rad/s and mm of tissue.
      entry: shares of the nodes in the entry friction at the end of the step.
      passing: weights of the nodes in the turn of the shaft at the entry, in the middle of the step.
    """

    link_mm: Array
    link: Array
    depth: Array
    tissue: Array
    sheath: Array
    damping: Array
    entry: Array
    passing: Array


@njit(cache=True)
def empty_chain(nodes: int) -> CellChain:
    """Zeros for that many nodes."""
    return CellChain(
        np.zeros(nodes),
        np.zeros(nodes + 1),
        np.zeros(nodes),
        np.zeros(nodes),
        np.zeros(nodes),
        np.zeros(nodes),
        np.zeros(nodes),
        np.zeros(nodes),
    )


@njit(cache=True)
def assemble(
    chain: CellChain,
    law: LawParameters,
    mesh: MeshSize,
    free: float,
    free_middle: float,
    inserted: float,
) -> None:
    """Fill the chain for these lengths, mm; `free_middle`: free length in the middle of the step."""
    if mesh.lagrangian:
        _lagrangian(chain, mesh, free, free_middle, inserted)
    else:
        _eulerian(chain, mesh, free, inserted)
    for i in range(mesh.nodes):
        chain.link[i] = law.rigidity / chain.link_mm[i]
        chain.damping[i] = _damping(law, chain.depth[i], chain.tissue[i], inserted)


@njit(cache=True)
def _eulerian(chain: CellChain, mesh: MeshSize, free: float, inserted: float) -> None:
    cells = mesh.nodes - mesh.free_cells - 2
    cell = inserted / cells
    for i in range(mesh.free_cells):
        chain.link_mm[i] = chain.sheath[i] = free / mesh.free_cells
    entry = mesh.free_cells
    chain.link_mm[0] = free if entry == 0 else 0.5 * free / entry
    if entry > 0:
        chain.link_mm[entry] = 0.5 * free / entry
    chain.entry[entry] = chain.passing[entry] = 1.0
    for i in range(cells):
        chain.link_mm[entry + 1 + i] = chain.tissue[entry + 1 + i] = cell
        chain.depth[entry + 1 + i] = (i + 0.5) * cell
    chain.link_mm[entry + 1] = chain.link_mm[mesh.nodes - 1] = 0.5 * cell
    chain.depth[mesh.nodes - 1] = inserted


@njit(cache=True)
def _lagrangian(
    chain: CellChain, mesh: MeshSize, free: float, free_middle: float, inserted: float
) -> None:
    cells = mesh.nodes - 1
    cell = (free + inserted) / cells
    for i in range(cells):
        chain.link_mm[i] = cell
        covered = min(max((i + 1) * cell - free, 0.0), cell)
        chain.tissue[i], chain.sheath[i] = covered, cell - covered
        chain.depth[i] = (i + 1) * cell - free - 0.5 * covered
    chain.link_mm[0] = chain.link_mm[cells] = 0.5 * cell
    chain.depth[cells] = inserted
    for shares, length in ((chain.entry, free), (chain.passing, free_middle)):
        position = min(max(length / cell - 0.5, 0.0), cells - 1.0)
        for i in range(cells):
            shares[i] = max(1.0 - abs(i - position), 0.0)


@njit(cache=True)
def _damping(law: LawParameters, depth: float, tissue: float, inserted: float) -> float:
    """Viscous torque per rad/s and per mm; its mean over the inserted length is the rig's."""
    if tissue == 0.0:
        return 0.0
    shallow = (law.boundary * inserted - depth) / tissue + 0.5
    shallow = min(max(shallow, 0.0), 1.0)
    mean = law.boundary + law.ratio * (1.0 - law.boundary)
    layered = (shallow + law.ratio * (1.0 - shallow)) / mean
    return law.damping * layered * (1.0 + law.gradient * (2.0 * depth / inserted - 1.0))

"""The chain of finite volumes at one moment: where nodes are and what touches them.

At constant inserted length the mesh is fixed in the tissue: free cells (if a sheath rubs), the entry,
inserted cells, the tip. If the inserted length changes, the mesh is fixed to the needle: cells from
chuck to tip, each in the tissue with the share of it that lies beyond the entry, and the tip.
Cells carry friction and sit in their middles; entry and tip are nodes without length.
"""

from typing import NamedTuple

import numpy as np
from numba import njit
from numpy.typing import NDArray

from validation.rig.laws import Law

Array = NDArray[np.float64]


class Mesh(NamedTuple):
    """How many nodes of which kind; `growing`: fixed to the needle."""

    nodes: int
    free_cells: int
    growing: bool


class Layout(NamedTuple):
    """Per node, in place: link i (length, stiffness) lies before node i; the last one is missing."""

    link_mm: Array
    link: Array
    depth: Array
    tissue: Array
    sheath: Array
    damping: Array
    entry: Array
    passing: Array


@njit(cache=True)
def empty_layout(nodes: int) -> Layout:
    """Space for that many nodes."""
    return Layout(
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
def lay_out(lay: Layout, law: Law, mesh: Mesh, free: float, free_middle: float, inserted: float) -> None:
    """Fill the layout for these lengths; `free_middle` is the free length in the middle of the step."""
    if mesh.growing:
        _along_needle(lay, mesh, free, free_middle, inserted)
    else:
        _in_tissue(lay, mesh, free, inserted)
    for i in range(mesh.nodes):
        lay.link[i] = law.rigidity / lay.link_mm[i]
        lay.damping[i] = _damping(law, lay.depth[i], lay.tissue[i], inserted)


@njit(cache=True)
def _in_tissue(lay: Layout, mesh: Mesh, free: float, inserted: float) -> None:
    cells = mesh.nodes - mesh.free_cells - 2
    cell = inserted / cells
    for i in range(mesh.free_cells):
        lay.link_mm[i] = lay.sheath[i] = free / mesh.free_cells
    at = mesh.free_cells
    lay.link_mm[0] = free if at == 0 else 0.5 * free / at
    if at > 0:
        lay.link_mm[at] = 0.5 * free / at
    lay.entry[at] = lay.passing[at] = 1.0
    for i in range(cells):
        lay.link_mm[at + 1 + i] = lay.tissue[at + 1 + i] = cell
        lay.depth[at + 1 + i] = (i + 0.5) * cell
    lay.link_mm[at + 1] = lay.link_mm[mesh.nodes - 1] = 0.5 * cell
    lay.depth[mesh.nodes - 1] = inserted


@njit(cache=True)
def _along_needle(lay: Layout, mesh: Mesh, free: float, free_middle: float, inserted: float) -> None:
    cells = mesh.nodes - 1
    cell = (free + inserted) / cells
    for i in range(cells):
        lay.link_mm[i] = cell
        covered = min(max((i + 1) * cell - free, 0.0), cell)
        lay.tissue[i], lay.sheath[i] = covered, cell - covered
        lay.depth[i] = (i + 1) * cell - free - 0.5 * covered
    lay.link_mm[0] = lay.link_mm[cells] = 0.5 * cell
    lay.depth[cells] = inserted
    for shares, length in ((lay.entry, free), (lay.passing, free_middle)):
        place = min(max(length / cell - 0.5, 0.0), cells - 1.0)
        for i in range(cells):
            shares[i] = max(1.0 - abs(i - place), 0.0)


@njit(cache=True)
def _damping(law: Law, depth: float, tissue: float, inserted: float) -> float:
    """Viscous torque per rad/s and per mm; its mean over the inserted length is the rig's."""
    if tissue == 0.0:
        return 0.0
    shallow = (law.boundary * inserted - depth) / tissue + 0.5
    shallow = min(max(shallow, 0.0), 1.0)
    mean = law.boundary + law.ratio * (1.0 - law.boundary)
    layered = (shallow + law.ratio * (1.0 - shallow)) / mean
    return law.damping * layered * (1.0 + law.gradient * (2.0 * depth / inserted - 1.0))

"""Where the nodes are, and how the tissue along an element loads its two nodes.

The tissue acts at two contact sites per element, at the fractions
(1 -+ sqrt(2/3)) / 2 of its length. Inside a covered stretch a site loads the nodes
as it lies between them; of all symmetric pairs these sites give the damping
a/12 [[5, 1], [1, 5]], half way between lumped and consistent, which cancels the
leading error of the spring chain, so that poles converge as a^4. That cancellation
is between neighbours, and at a free tip with its mirror image: where coverage ends
otherwise, the loads of a node are instead those of the exact integrals of the law,
taken as linear along the element.
"""

from sim.kernel import memory_map
from sim.kernel.compiled import Array, inlined

XI_LEFT = 0.5 * (1.0 - (2.0 / 3.0) ** 0.5)
XI_RIGHT = 1.0 - XI_LEFT


@inlined
def place_nodes(head: Array, mesh: Array, free: float, x: Array) -> None:
    """Node positions from the chuck, m.

    With `stretching` elements the mesh stands still in the tissue and those
    elements share the free length; without, it is fixed to the needle.
    """
    stretching = int(head[memory_map.H_STRETCHING])
    scale, shift = 1.0, 0.0
    if stretching > 0:
        scale = free / head[memory_map.H_FREE_REF]
        shift = free - head[memory_map.H_FREE_REF]
    for i in range(x.size):
        x[i] = mesh[i] * scale if i < stretching else mesh[i] + shift


@inlined
def _clip(value: float, low: float, high: float) -> float:
    return min(max(value, low), high)


@inlined
def _match(total: float, moment: float) -> tuple[float, float]:
    """Loads of the two sites with a given sum and first moment, none negative."""
    right = _clip((moment - XI_LEFT * total) / (XI_RIGHT - XI_LEFT), 0.0, total)
    return total - right, right


@inlined
def _locate(x: Array, place: float, point: Array) -> None:
    """Element that holds a place, and the fraction of it before the place."""
    n = x.size - 1
    e = 0
    while e < n - 1 and x[e + 1] < place:
        e += 1
    point[0] = e
    point[1] = (place - x[e]) / (x[e + 1] - x[e])


@inlined
def cover(
    row: Array, x: Array, free: float, inserted: float, tip_loaded: bool, loads: Array, point: Array
) -> None:
    """What a row's sites load the nodes with, m: (n, 4), left node then right node.

    A point row fills `point` instead. `tip_loaded`: the tip carries torque. What begins in the tissue,
    by L_TOP_FREE, does not reach out of it.
    """
    n = x.size - 1
    top = (
        row[memory_map.L_TOP_CONST]
        + row[memory_map.L_TOP_FREE] * free
        + row[memory_map.L_TOP_INSERTED] * inserted
    )
    top = _clip(top, row[memory_map.L_TOP_FREE] * free, x[n])
    near = 1e-9 * (x[n] - x[0])
    if row[memory_map.L_POINT] != 0.0:
        if top >= free + inserted - near:
            top = x[n]  # the tip, even of a mesh that reaches beyond it
        _locate(x, top, point)
        return
    end = (
        row[memory_map.L_END_CONST]
        + row[memory_map.L_END_FREE] * free
        + row[memory_map.L_END_INSERTED] * inserted
    )
    end = _clip(end, top, x[n])
    for e in range(n):
        if x[e + 1] <= top or x[e] >= end:
            loads[e, 0] = loads[e, 1] = loads[e, 2] = loads[e, 3] = 0.0
            continue
        a = x[e + 1] - x[e]
        if x[e] >= top - near and x[e + 1] <= end + near:
            first = e == 0 or x[e - 1] < top - near
            last = tip_loaded if e == n - 1 else x[e + 2] > end + near
            if first:
                loads[e, 0], loads[e, 1] = _match(0.5 * a, a / 6.0)
            else:
                loads[e, 0], loads[e, 1] = 0.5 * a * XI_RIGHT, 0.5 * a * XI_LEFT
            if last:
                loads[e, 2], loads[e, 3] = _match(0.5 * a, a / 3.0)
            else:
                loads[e, 2], loads[e, 3] = 0.5 * a * XI_LEFT, 0.5 * a * XI_RIGHT
            continue
        s0 = _clip((top - x[e]) / a, 0.0, 1.0)
        s1 = _clip((end - x[e]) / a, 0.0, 1.0)
        length = s1 - s0
        square = 0.5 * (s1 * s1 - s0 * s0)
        cube = (s1 * s1 * s1 - s0 * s0 * s0) / 3.0
        loads[e, 0], loads[e, 1] = _match(a * (length - square), a * (square - cube))
        loads[e, 2], loads[e, 3] = _match(a * square, a * cube)

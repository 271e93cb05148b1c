"""Where the nodes are, and which part of each element a row of the law covers.

The tissue acts at two contact sites an element, at the fractions
(1 -+ sqrt(2/3)) / 2 of its length. Of all symmetric pairs these give the element
damping a/12 [[5, 1], [1, 5]], half way between lumped and consistent, which
cancels the leading error of the spring chain: poles converge as a^4. Where only
part of an element is covered, the two weights keep the covered length and, as
long as they stay positive, its centroid.
"""

from sim.kernel import wire
from sim.kernel.compiled import compiled, inlined

XI_LEFT = 0.5 * (1.0 - (2.0 / 3.0) ** 0.5)
XI_RIGHT = 1.0 - XI_LEFT


@inlined
def place_nodes(head, mesh, free, x):
    """Node positions from the chuck, m.

    With `stretching` elements the mesh stands still in the tissue and those
    elements share the free length; without, it is fixed to the needle.
    """
    stretching = int(head[wire.H_STRETCHING])
    scale, shift = 1.0, 0.0
    if stretching > 0:
        scale = free / head[wire.H_FREE_REF]
        shift = free - head[wire.H_FREE_REF]
    for i in range(x.size):
        x[i] = mesh[i] * scale if i < stretching else mesh[i] + shift


@inlined
def _clip(value, low, high):
    return min(max(value, low), high)


@inlined
def cover(row, x, free, inserted, weights, point):
    """Weights of a row's sites, m; or, for a point row, its element and place in it."""
    n = x.size - 1
    top = row[wire.L_TOP_CONST] + row[wire.L_TOP_FREE] * free + row[wire.L_TOP_INSERTED] * inserted
    top = _clip(top, 0.0, x[n])
    if row[wire.L_POINT] != 0.0:
        e = 0
        while e < n - 1 and x[e + 1] < top:
            e += 1
        point[0] = e
        point[1] = (top - x[e]) / (x[e + 1] - x[e])
        return
    end = row[wire.L_END_CONST] + row[wire.L_END_FREE] * free + row[wire.L_END_INSERTED] * inserted
    end = _clip(end, top, x[n])
    for e in range(n):
        a = x[e + 1] - x[e]
        if x[e] >= top and x[e + 1] <= end:
            weights[e, 0] = weights[e, 1] = 0.5 * a
            continue
        s0 = _clip((top - x[e]) / a, 0.0, 1.0)
        s1 = _clip((end - x[e]) / a, 0.0, 1.0)
        covered = s1 - s0
        right = covered * (0.5 * (s0 + s1) - XI_LEFT) / (XI_RIGHT - XI_LEFT)
        right = _clip(right, 0.0, covered)
        weights[e, 0] = (covered - right) * a
        weights[e, 1] = right * a

"""Advection of the tissue's twist: tissue stays where it is while the shaft slides through.

Tissue twist is remembered at contact sites, which travel with the needle. After
a step in which the needle moved by d into the tissue, the twist of a site is that
of the place to which it moved, phi(x) <- phi(x + d), by quadratic interpolation
(second order, stable while the nearest site is the middle one). Tissue that the
tip enters is untwisted; at the entry the twist goes on as it runs.
"""

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.mesh import XI_LEFT, XI_RIGHT


@inlined
def _covered(loads: Array, site: int) -> bool:
    e, k = site // 2, site % 2
    return loads[e, k] + loads[e, 2 + k] > 0.0


@inlined
def _place(x: Array, site: int) -> float:
    e = site // 2
    return x[e] + (XI_RIGHT if site % 2 == 1 else XI_LEFT) * (x[e + 1] - x[e])


@embedded
def forget_uncovered(loads: Array, state: Array) -> None:
    """A site that no tissue touches remembers nothing."""
    for site in range(2 * loads.shape[0]):
        if not _covered(loads, site):
            for j in range(memory_map.SITE):
                state[site // 2, site % 2, j] = 0.0


@embedded
def _interpolate(places: Array, twist: Array, count: int, middle: int, target: float) -> float:
    """The parabola through three sites around `middle`; straight at two or at an end."""
    if count == 1:
        return twist[0]
    if count == 2 or target < places[0] or target > places[count - 1]:
        i = min(max(middle, 0), count - 2)
        slope = (twist[i + 1] - twist[i]) / (places[i + 1] - places[i])
        return twist[i] + slope * (target - places[i])
    i = min(max(middle, 1), count - 2)
    a, b, c = places[i - 1], places[i], places[i + 1]
    return (
        twist[i - 1] * (target - b) * (target - c) / ((a - b) * (a - c))
        + twist[i] * (target - a) * (target - c) / ((b - a) * (b - c))
        + twist[i + 1] * (target - a) * (target - b) / ((c - a) * (c - b))
    )


@embedded
def advect_tissue(d: float, x: Array, loads: Array, state: Array, places: Array, twist: Array) -> None:
    """Shift the twist of the tissue by d, m (positive: needle into the tissue).

    Args:
      places, twist: working memory, (2 n + 1,) each.
    """
    n = loads.shape[0]
    count, first, last = 0, -1, -1
    for site in range(2 * n):
        if _covered(loads, site):
            places[count], twist[count] = _place(x, site), state[site // 2, site % 2, memory_map.PHI]
            first = site if count == 0 else first
            last = site
            count += 1
    if count == 0:
        return
    if d > 0.0 and last == 2 * n - 1:
        places[count], twist[count] = x[n], 0.0
        count += 1
    middle = 0
    # From the site before the entry, which may be covered next, to the last one.
    for site in range(max(first - 1, 0), last + 1):
        target = _place(x, site) + d
        while middle + 1 < count and places[middle + 1] - target < target - places[middle]:
            middle += 1
        state[site // 2, site % 2, memory_map.PHI] = _interpolate(places, twist, count, middle, target)

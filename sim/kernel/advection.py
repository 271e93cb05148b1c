"""Advection of the tissue's twist past the sites that remember it.

Tissue stays where it is while the shaft slides through. If contact sites travel with the needle, then
after a step in which it moved by d into the tissue, the twist of a site is that of the place to which
it moved, phi(x) <- phi(x + d), by quadratic interpolation (second order, stable while the nearest site
is the middle one). Tissue that the tip enters is untwisted; at the entry the twist goes on as it runs.

Tissue that is dragged along goes with the shaft: its twist stays at sites that travel with the needle,
and is shifted by -d at sites that stand still; what is dragged in at the entry is untwisted. If it is
dragged in part, that part of the twist goes along.
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


@inlined
def _entry(x: Array, loads: Array, site: int) -> float:
    """Where the covered part of a site's element begins, m: it ends with the element."""
    e = site // 2
    covered = loads[e, 0] + loads[e, 1] + loads[e, 2] + loads[e, 3]
    return max(x[e + 1] - covered, x[e])


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
def advect_tissue(
    d: float,
    share: float,
    x: Array,
    loads: Array,
    state: Array,
    places: Array,
    twist: Array,
    untwisted: bool,
) -> None:
    """Shift a share of the twist of the tissue by d, m: phi(x) <- phi(x + d).

    Args:
      places, twist: working memory, (2 n + 1,) each.
      untwisted: whether what comes in at the entry is untwisted; else the twist goes on as it runs.
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
    middle, entry = 0, _entry(x, loads, first)
    # From the site before the entry, which may be covered next, to the last one.
    for site in range(max(first - 1, 0), last + 1):
        target = _place(x, site) + d
        while middle + 1 < count and places[middle + 1] - target < target - places[middle]:
            middle += 1
        shifted = _interpolate(places, twist, count, middle, target)
        if untwisted and target < places[0]:
            within = (target - entry) / max(places[0] - entry, target - entry)
            shifted = twist[0] * max(within, 0.0)
        before = state[site // 2, site % 2, memory_map.PHI]
        state[site // 2, site % 2, memory_map.PHI] = before + share * (shifted - before)

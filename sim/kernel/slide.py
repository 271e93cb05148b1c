"""Tissue stays where it is while the shaft slides through it.

Tissue twist is remembered at contact sites, which travel with the needle. After
a step in which the needle moved by d into the tissue, the twist of a site is that
of the place to which it moved: phi <- phi + d dphi/dx. Tissue that the tip enters
is untwisted; tissue at the entry is as twisted as its nearest neighbour.
"""

from sim.kernel.mesh import XI_LEFT, XI_RIGHT
from sim.kernel import wire
from sim.kernel.compiled import compiled, inlined


@inlined
def _covered(loads, site):
    return loads[site // 2, site % 2] + loads[site // 2, 2 + site % 2] > 0.0


@compiled
def forget_uncovered(loads, state):
    """A site that no tissue touches remembers nothing."""
    for e in range(loads.shape[0]):
        for k in range(2):
            if not _covered(loads, 2 * e + k):
                for j in range(wire.SITE):
                    state[e, k, j] = 0.0


@compiled
def slide_tissue(d, x, loads, state):
    """Shift the twist of the tissue by d, m (positive: needle into the tissue)."""
    n = loads.shape[0]
    last = -1  # the previous covered site, as 2 e + k
    here = 0.0  # its place
    old = 0.0  # its twist before this sweep
    slope_back = 0.0
    for site in range(2 * n):
        e, k = site // 2, site % 2
        if not _covered(loads, site):
            continue
        place = x[e] + (XI_RIGHT if k == 1 else XI_LEFT) * (x[e + 1] - x[e])
        phi = state[e, k, wire.PHI]
        if last >= 0:
            slope = (phi - old) / (place - here)
            back = slope if slope_back == 0.0 else slope_back
            state[last // 2, last % 2, wire.PHI] = old + d * (slope if d > 0.0 else back)
            slope_back = slope
        last, here, old = site, place, phi
    if last < 0:
        return
    in_tissue = last == 2 * n - 1
    ahead = -old / max(x[n] - here, abs(d)) if in_tissue else 0.0
    state[last // 2, last % 2, wire.PHI] = old + d * (ahead if d > 0.0 else slope_back)
    _extend(loads, state)


@compiled
def _extend(loads, state):
    """Give sites that are about to be covered at the entry their neighbour's twist."""
    n = loads.shape[0]
    for site in range(2 * n - 2, -1, -1):
        e, k = site // 2, site % 2
        ahead = site + 1
        if not _covered(loads, site) and _covered(loads, ahead):
            state[e, k, wire.PHI] = state[ahead // 2, ahead % 2, wire.PHI]

"""From stage to stage: all that is remembered is carried on (sim.kernel.method)."""

import math

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.stage.assemble import is_linear
from sim.kernel.stage.workspace import Frame, Workspace


@inlined
def next_stage(
    law: Array,
    theta: Array,
    rates: Array,
    before: Array,
    w: Workspace,
    frame: Frame,
    kept: float,
    carried: float,
) -> None:
    """Start the next stage: angles, rates and the memory of the sites.

    Args:
      law: (rows, columns).
      theta, rates: of the nodes at the start of the step, rad and rad/s, (n + 1).
      before: memory of the contact sites there, (rows, n, 2, SITE).
      kept, carried: coefficients of the method.
    """
    angles, omega, rest = w.theta, w.omega, w.rest
    for i in range(omega.size):
        reached = angles[i] + frame.g * omega[i]
        angles[i] = theta[i] + kept * (angles[i] - theta[i]) + carried * (reached - angles[i])
        rest[i] = rates[i] + kept * (rest[i] - rates[i]) + carried * (omega[i] - rest[i])
    start, end = w.start, w.end
    for r in range(law.shape[0]):
        if not is_linear(law[r]):
            over = law[r, memory_map.L_CONTACT]
            signed = over in (memory_map.BROKEN, memory_map.TURNED, memory_map.ALIGNED)
            _carry_sites(before[r], start[r], end[r], frame.yield_angle, signed, kept, carried)


@embedded
def _carry_sites(
    before: Array, start: Array, end: Array, limit: float, signed: bool, kept: float, carried: float
) -> None:
    """The memory of a row's sites, (n, 2, SITE) each; what they have been through may have a sign."""
    for e in range(before.shape[0]):
        for k in range(2):
            for j in range(memory_map.SITE):
                first, last = before[e, k, j], start[e, k, j]
                start[e, k, j] = first + kept * (last - first) + carried * (end[e, k, j] - last)
            dry, turn = start[e, k, memory_map.Z_DRY], start[e, k, memory_map.Z_TURN]
            axial = start[e, k, memory_map.Z_AXIAL]
            start[e, k, memory_map.Z_DRY] = min(max(dry, -limit), limit)
            if not signed:
                start[e, k, memory_map.PAST] = max(start[e, k, memory_map.PAST], 0.0)
            size = math.sqrt(turn * turn + axial * axial)
            if size > limit:
                start[e, k, memory_map.Z_TURN] = turn * limit / size
                start[e, k, memory_map.Z_AXIAL] = axial * limit / size

"""What a stage has done: torque and power of all friction, by balance of the shaft."""

from sim.kernel.compiled import Array, inlined
from sim.kernel.stage.assemble import twist_of
from sim.kernel.stage.workspace import Frame, Workspace


@inlined
def friction(
    w: Workspace,
    frame: Frame,
    torque: float,
    tip_torque: float,
    weight: float,
    tissue: Array,
) -> tuple[float, float]:
    """Torque of all friction on the shaft, N m, and its power, W.

    By balance, so that the sums hold to rounding: what inertia and torsion do not
    take of the external torques is friction.

    Args:
      torque: of the drive, N m.
      tip_torque: that resists at the tip, N m.
      weight: share of the stage in its step.
      tissue: gains what friction does to every node, N m, times the weight, (n + 1).
    """
    theta, omega, rest, spring, inertia = w.theta, w.omega, w.rest, w.spring, w.inertia
    n = omega.size - 1
    total, power, arriving = 0.0, 0.0, torque
    for i in range(n + 1):
        leaving = tip_torque
        if i < n:
            leaving = -spring[i] * (twist_of(theta, omega, i, frame.g) - w.set[i])
        share = arriving - leaving - inertia[i] * (omega[i] - rest[i])
        total += share
        power += share * omega[i]
        tissue[i] -= weight * share
        arriving = leaving
    return total, power


@inlined
def stored_in_shaft(w: Workspace, end: Array) -> tuple[float, float]:
    """Energy that the twisted shaft stores, J, and the largest torque that an element carries, N m."""
    energy, largest = 0.0, 0.0
    for e in range(end.size - 1):
        twist = end[e + 1] - end[e] - w.set[e]
        energy += 0.5 * w.spring[e] * twist * twist
        largest = max(largest, abs(w.spring[e] * twist))
    return energy, largest

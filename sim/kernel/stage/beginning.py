"""What the first stage of a step starts from: springs, rates, loads and viscous rows."""

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.mesh import cover, place_nodes
from sim.kernel.shaft import Shaft
from sim.kernel.stage.assemble import add_shaft_damping, add_viscous, is_idle, is_linear
from sim.kernel.stage.inputs import Inputs
from sim.kernel.stage.workspace import Frame, Workspace

_RIGID = 1e-3
"""Twist of an element beyond the tip, over that of the same element of the shaft."""


@inlined
def begin(
    head: Array,
    mesh: Array,
    law: Array,
    shaft: Shaft,
    theta: Array,
    rates: Array,
    before: Array,
    w: Workspace,
    frame: Frame,
    inputs: Inputs,
) -> bool:
    """Fill in what the step starts from; returns whether its stages have to be iterated.

    Args:
      head, mesh, law: numeric fields of the model; law is (rows, columns).
      theta, rates: of the nodes, rad and rad/s, (n + 1).
      before: memory of the contact sites, (rows, n, 2, SITE).
    """
    inertia, damp_lower, damp_diagonal = w.inertia, w.damp_lower, w.damp_diagonal
    damp_upper, angles, rest, omega = w.damp_upper, w.theta, w.rest, w.omega
    place_nodes(head, mesh, inputs.free, w.x)
    _set_springs(head, shaft, w, inputs)
    for i in range(omega.size):
        inertia[i] = shaft.inertia[i] / frame.g
        angles[i] = theta[i]
        rest[i] = omega[i] = rates[i]
        damp_lower[i] = damp_diagonal[i] = damp_upper[i] = 0.0
    if head[memory_map.H_SHAFT_DAMPING] > 0.0:
        add_shaft_damping(w, head[memory_map.H_SHAFT_DAMPING])
    sites_nonlinear = _load_sites(law, before, w, inputs)
    return sites_nonlinear or _is_nonlinear(head, frame)


@inlined
def _set_springs(head: Array, shaft: Shaft, w: Workspace, inputs: Inputs) -> None:
    """Stiffness of the elements at the lengths of this step."""
    x, springs, nominal, spring = w.x, w.spring, w.nominal, shaft.spring
    stretching = int(head[memory_map.H_STRETCHING])
    for i in range(nominal.size - 1):
        springs[i] = spring[i]
        if i < stretching:  # torsion falls as the length of the element grows
            springs[i] *= head[memory_map.H_FREE_REF] / inputs.free
        if head[memory_map.H_FED] != 0.0:  # beyond the tip there is no shaft that could twist
            within = (inputs.free + inputs.inserted - x[i]) / (x[i + 1] - x[i])
            springs[i] /= min(max(within, _RIGID), 1.0)
        nominal[i] = springs[i]


@inlined
def _is_nonlinear(head: Array, frame: Frame) -> bool:
    """Whether chuck or shaft ask for iteration, whatever the tissue does."""
    chuck = frame.backlash > 0.0 or frame.grip > 0.0 or frame.unwinding != 1.0
    shaft = head[memory_map.H_STIFFNESS_TORQUE] > 0.0 or frame.yield_torque > 0.0
    return chuck or shaft or frame.creep > 0.0 or frame.joint > 0.0


@inlined
def _load_sites(law: Array, before: Array, w: Workspace, inputs: Inputs) -> bool:
    """Where rows load the nodes, and viscous rows; returns whether one is more than viscous."""
    loads, point, start, end = w.loads, w.point, w.start, w.end
    nonlinear = False
    for r in range(law.shape[0]):
        if is_idle(law[r]):
            continue
        cover(law[r], w.x, inputs.free, inputs.inserted, inputs.tip_loaded, loads[r], point[r])
        if is_linear(law[r]):
            add_viscous(w, loads[r], law[r, memory_map.L_VISCOUS])
        else:
            nonlinear = True
            _hold_sites(before[r], start[r], end[r])
    return nonlinear


@embedded
def _hold_sites(before: Array, start: Array, end: Array) -> None:
    """The first stage starts from the memory of a row's sites, (n, 2, SITE) each."""
    for e in range(before.shape[0]):
        for k in range(2):
            for j in range(memory_map.SITE):
                start[e, k, j] = end[e, k, j] = before[e, k, j]

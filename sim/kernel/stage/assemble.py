"""The stage equation of the chain, linearised: one function per kind of term.

    I/g (w - w*) + K (theta* + g w) + D w + sum over sites of N f(N' w) = drive - tip

The damping D of viscous rows is assembled once per step; the sites of every other row add
their torque and slope at each iteration.
"""

import math
from typing import NamedTuple

from sim.kernel import memory_map
from sim.kernel.compiled import Array, embedded, inlined
from sim.kernel.mesh import XI_LEFT, XI_RIGHT
from sim.kernel.site.curves import contact_factor, mean_factor
from sim.kernel.site.kerf import kerf_energy
from sim.kernel.site.law import site_law
from sim.kernel.site.memory import Stage, recall, remember
from sim.kernel.stage.workspace import Frame, Workspace

# A place is the end of the shaft if it lies within this fraction of the last element.
_AT_END = 0.01


@inlined
def is_linear(row: Array) -> bool:
    """Whether a row is viscous friction alone: no state, no iteration."""
    return (
        row[memory_map.L_EXPONENT] == 1.0
        and row[memory_map.L_KINETIC] == 0.0
        and row[memory_map.L_STATIC] == 0.0
        and row[memory_map.L_SHARED] == 0.0
        and row[memory_map.L_STIFFNESS] == 0.0
        and row[memory_map.L_CURVATURE] == 0.0
        and row[memory_map.L_WAVE] == 0.0
        and row[memory_map.L_KEYED] == 0.0
        and row[memory_map.L_LOAD] == 0.0
        and row[memory_map.L_POINT] == 0.0
        and row[memory_map.L_SHAPED] == 0.0
    )


@inlined
def is_idle(row: Array) -> bool:
    """Whether a row does nothing: rows that make tables of different rigs equally long."""
    return is_linear(row) and row[memory_map.L_VISCOUS] == 0.0


@inlined
def add_viscous(w: Workspace, loads: Array, beta: float) -> None:
    """Damping of a viscous row: what the rates at the sites load the nodes with."""
    lower, diagonal, upper = w.damp_lower, w.damp_diagonal, w.damp_upper
    for e in range(loads.shape[0]):
        l0, l1, r0, r1 = loads[e, 0], loads[e, 1], loads[e, 2], loads[e, 3]
        diagonal[e] += beta * (XI_RIGHT * l0 + XI_LEFT * l1)
        upper[e] += beta * (XI_LEFT * l0 + XI_RIGHT * l1)
        lower[e + 1] += beta * (XI_RIGHT * r0 + XI_LEFT * r1)
        diagonal[e + 1] += beta * (XI_LEFT * r0 + XI_RIGHT * r1)


@inlined
def add_shaft_damping(w: Workspace, time: float) -> None:
    """Damping of the material: torque of an element = stiffness (twist + time * its rate)."""
    for e in range(w.nominal.size - 1):
        damping = time * w.nominal[e]
        w.damp_diagonal[e] += damping
        w.damp_upper[e] -= damping
        w.damp_lower[e + 1] -= damping
        w.damp_diagonal[e + 1] += damping


@inlined
def add_viscous_advection(w: Workspace, loads: Array, beta: float, frame: Frame) -> None:
    """Slip of a viscous row because a twisted shaft slides against the mesh: advection.

    The slip gains drift dtheta/dx: linear in the angles at the end of the stage,
    its part in the rates enters the matrix and its part in theta* the residual.
    """
    x, theta, omega = w.x, w.theta, w.omega
    rhs, lower, diagonal, upper = w.rhs, w.lower, w.diagonal, w.upper
    for e in range(loads.shape[0]):
        per_length = beta * frame.drift / (x[e + 1] - x[e])
        left = per_length * (loads[e, 0] + loads[e, 1])
        right = per_length * (loads[e, 2] + loads[e, 3])
        twist = twist_of(theta, omega, e, frame.g)
        rhs[e] -= left * twist
        rhs[e + 1] -= right * twist
        diagonal[e] -= frame.g * left
        upper[e] += frame.g * left
        lower[e + 1] -= frame.g * right
        diagonal[e + 1] += frame.g * right


@inlined
def twist_of(theta: Array, omega: Array, e: int, g: float) -> float:
    """Twist of element e at the end of the stage, rad."""
    return theta[e + 1] - theta[e] + g * (omega[e + 1] - omega[e])


@inlined
def add_linear(w: Workspace, g: float, with_matrix: bool) -> None:
    """Inertia, torsion and viscous rows: the residual, and the matrix if wanted."""
    theta, omega, rest, rhs = w.theta, w.omega, w.rest, w.rhs
    spring, inertia = w.spring, w.inertia
    damp_lower, damp_diagonal, damp_upper = w.damp_lower, w.damp_diagonal, w.damp_upper
    lower, diagonal, upper = w.lower, w.diagonal, w.upper
    n = omega.size - 1
    arriving, before, previous = 0.0, 0.0, 0.0
    for i in range(n):
        here, ahead = omega[i], omega[i + 1]
        after = g * spring[i]
        leaving = -spring[i] * (theta[i + 1] - theta[i]) - after * (ahead - here)
        damping = damp_lower[i] * previous + damp_diagonal[i] * here + damp_upper[i] * ahead
        rhs[i] = arriving - leaving - damping - inertia[i] * (here - rest[i])
        if with_matrix:
            lower[i] = damp_lower[i] - before
            upper[i] = damp_upper[i] - after
            diagonal[i] = damp_diagonal[i] + inertia[i] + before + after
        arriving, before, previous = leaving, after, here
    damping = damp_lower[n] * previous + damp_diagonal[n] * omega[n]
    rhs[n] = arriving - damping - inertia[n] * (omega[n] - rest[n])
    if with_matrix:
        lower[n] = damp_lower[n] - before
        diagonal[n] = damp_diagonal[n] + inertia[n] + before


@embedded
def add_row(w: Workspace, r: int, row: Array, frame: Frame, tip_torque: float) -> tuple[float, float]:
    """Every covered site of a row that is more than viscous.

    Returns the power that goes into twisted tissue and bent shaft, W, and the energy stored in the
    tissue, J, but for what tissue that hardens adds to both.
    """
    theta, omega, before, after = w.theta, w.omega, w.start[r], w.end[r]
    stage = Stage(frame.g, frame.axial, frame.yield_angle, frame.factor)
    g, n, is_point = frame.g, omega.size - 1, row[memory_map.L_POINT] != 0.0
    load, curvature, wave = row[memory_map.L_LOAD], row[memory_map.L_CURVATURE], row[memory_map.L_WAVE]
    cycles, phase, keyed = row[memory_map.L_CYCLES], row[memory_map.L_PHASE], row[memory_map.L_KEYED]
    factor = frame.factor if row[memory_map.L_VARIES] != 0.0 else 1.0
    if row[memory_map.L_VARIES] == memory_map.TORQUE_VARIES:
        curvature, wave = factor * curvature, factor * wave
    recoverable, stored = 0.0, 0.0
    for index in range(1 if is_point else 2 * n):
        at = _site(w, r, index, is_point)
        weight = at.to_left + at.to_right
        if weight == 0.0:
            continue
        e = at.element
        twist = twist_of(theta, omega, e, g)
        per_length = frame.drift / (w.x[e + 1] - w.x[e])
        turning = at.left * omega[e] + at.right * omega[e + 1]
        rate = turning + per_length * twist
        at_tip = e == n - 1 and at.right > 1.0 - _AT_END
        extra = load * abs(tip_torque if at_tip else w.spring[e] * twist)
        angle = cycles * (at.left * theta[e] + at.right * theta[e + 1] + g * turning) - phase
        if keyed > 0.0:
            extra += keyed * (1.0 + math.cos(angle))
        last = after[at.slot, at.k, memory_map.SLIP]
        old = recall(before[at.slot, at.k])
        torque, slope, slip, new = site_law(rate, row, extra, old, stage, last)
        remember(after[at.slot, at.k], new, slip)
        if row[memory_map.L_KERF] > 0.0:
            stored += weight * kerf_energy(new.phi, row)
            recoverable += weight * torque * (new.phi - old.phi) / g  # what is cut anew is lost
        else:
            stiffness = factor * weight * row[memory_map.L_STIFFNESS]
            stored += 0.5 * stiffness * new.phi * new.phi
            recoverable += stiffness * new.phi * (new.phi - old.phi) / g  # what flows is lost
        if curvature != 0.0 or wave != 0.0:
            sine, cosine = math.sin(angle), math.cos(angle)
            torque += curvature * sine + wave * cosine * rate
            slope += g * cycles * (curvature * cosine - wave * sine * rate) + wave * cosine
            recoverable += weight * curvature * sine * turning
        if keyed > 0.0:
            slope -= g * cycles * keyed * math.sin(angle) * new.dry / frame.yield_angle
        _load(w, at, torque, slope, g * per_length)
    return recoverable, stored


class _Site(NamedTuple):
    """Where a row acts, what it reads of the ends of that element, and how it loads them."""

    element: int
    slot: int  # of the site states
    k: int
    left: float  # parts of the ends in what it reads
    right: float
    to_left: float  # what a torque per length there loads the ends with, m; of a point, its parts
    to_right: float


@embedded
def _site(w: Workspace, r: int, index: int, is_point: bool) -> _Site:
    """A site of a row: its only one if the row is a point, else one of two in an element."""
    if is_point:
        right = w.point[r, 1]
        return _Site(int(w.point[r, 0]), 0, 0, 1.0 - right, right, 1.0 - right, right)
    e, k = index // 2, index % 2
    right = XI_RIGHT if k == 1 else XI_LEFT
    return _Site(e, e, k, 1.0 - right, right, w.loads[r, e, k], w.loads[r, e, 2 + k])


@embedded
def _load(w: Workspace, at: _Site, torque: float, slope: float, tilt: float) -> None:
    """Put the torque of a site and its slope on the ends of its element.

    `tilt` is what the slip gains by advection per rate of twist: as the shaft slides, the site reads
    less of the left end and more of the right one.
    """
    e, left, right = at.element, at.left - tilt, at.right + tilt
    w.rhs[e] -= at.to_left * torque
    w.rhs[e + 1] -= at.to_right * torque
    w.diagonal[e] += at.to_left * slope * left
    w.upper[e] += at.to_left * slope * right
    w.lower[e + 1] += at.to_right * slope * left
    w.diagonal[e + 1] += at.to_right * slope * right


@embedded
def hardening_power(w: Workspace, r: int, row: Array, frame: Frame) -> float:
    """Power that tissue of a row takes beyond that at its stiffness at rest, where it hardens, W."""
    power = 0.0
    for site in range(2 * w.loads[r].shape[0] if _hardens(row) else 0):
        e, k = site // 2, site % 2
        phi, was = w.end[r, e, k, memory_map.PHI], w.start[r, e, k, memory_map.PHI]
        factor, lost = contact_factor(abs(phi), row)[0], 0.0
        if row[memory_map.L_CONTACT] == memory_map.STRAINED:
            factor = contact_factor(w.end[r, e, k, memory_map.PAST], row)[0]
            lost = contact_factor(w.start[r, e, k, memory_map.PAST], row)[0] - factor
        taken = (factor - 1.0) * phi * (phi - was) - 0.5 * lost * phi * phi
        power += _stiffness_at(w, r, row, frame, e, k) * taken / frame.g
    return power


@embedded
def hardening_energy(w: Workspace, r: int, row: Array, frame: Frame) -> float:
    """Energy stored in the tissue of a row that hardens, beyond that at its stiffness at rest, J."""
    energy = 0.0
    for site in range(2 * w.loads[r].shape[0] if _hardens(row) else 0):
        e, k = site // 2, site % 2
        phi = abs(w.end[r, e, k, memory_map.PHI])
        if row[memory_map.L_CONTACT] == memory_map.STRAINED:
            factor = contact_factor(w.end[r, e, k, memory_map.PAST], row)[0]
        else:
            factor = mean_factor(phi, row)
        energy += 0.5 * _stiffness_at(w, r, row, frame, e, k) * phi * phi * (factor - 1.0)
    return energy


@inlined
def _hardens(row: Array) -> bool:
    return row[memory_map.L_CONTACT] >= memory_map.TWIST and row[memory_map.L_POINT] == 0.0


@inlined
def _stiffness_at(w: Workspace, r: int, row: Array, frame: Frame, e: int, k: int) -> float:
    """Stiffness at rest of the tissue of a site, N m / rad."""
    factor = frame.factor if row[memory_map.L_VARIES] != 0.0 else 1.0
    return factor * row[memory_map.L_STIFFNESS] * (w.loads[r, e, k] + w.loads[r, e, 2 + k])
